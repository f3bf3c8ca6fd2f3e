//! The groups of a drawing in DXF: a code and a value, each on its own line.

use coupler_curves::geometry::Point;

/// A group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    pub code: i32,
    pub value: &'a str,
    /// The number of its value's line.
    pub line: usize,
}

impl Group<'_> {
    /// # Errors
    /// Its value is no finite number.
    pub fn number(&self) -> Result<f64, String> {
        let value = self.value.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| {
            format!(
                "line {}: `{}` is not a number, as group {} is",
                self.line,
                super::super::drawing::shorten(self.value),
                self.code
            )
        })
    }
}

/// The groups of a text.
///
/// # Errors
/// A code that is no number.
pub(super) fn groups(text: &str) -> Result<Vec<Group<'_>>, String> {
    let mut lines = (1..).zip(text.lines().map(|line| line.trim_matches(|c: char| c.is_whitespace() || c == '\u{1a}')));
    let mut groups = Vec::new();
    while let Some((number, code)) = lines.next() {
        let Some((line, value)) = lines.next() else { break };
        let code = code.parse().map_err(|_| {
            format!("line {number}: `{}` is not the code of a group of DXF", super::super::drawing::shorten(code))
        })?;
        groups.push(Group { code, value, line });
    }
    Ok(groups)
}

/// What begins with a group 0: an entity, a section, an entry of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record<'g, 'a> {
    pub kind: &'a str,
    pub line: usize,
    pub groups: &'g [Group<'a>],
}

impl<'a> Record<'_, 'a> {
    /// The records in some groups.
    pub fn all<'g>(groups: &'g [Group<'a>]) -> Vec<Record<'g, 'a>> {
        let starts: Vec<usize> = (0..groups.len()).filter(|k| groups[*k].code == 0).collect();
        let end = |k: usize| starts.get(k + 1).copied().unwrap_or(groups.len());
        let record = |(k, start): (usize, &usize)| Record {
            kind: groups[*start].value,
            line: groups[*start].line,
            groups: &groups[start + 1..end(k)],
        };
        starts.iter().enumerate().map(record).collect()
    }

    pub fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// # Errors
    /// It is no number.
    pub fn number(&self, code: i32) -> Result<Option<f64>, String> {
        self.groups.iter().find(|group| group.code == code).map(Group::number).transpose()
    }

    /// A number that it must have.
    ///
    /// # Errors
    /// There is none.
    pub fn needed(&self, code: i32) -> Result<f64, String> {
        self.number(code)?.ok_or_else(|| format!("line {}: the {} has no group {code}", self.line, self.kind))
    }

    /// The bits of its flags.
    pub fn flags(&self, code: i32) -> i64 {
        self.text(code).and_then(|text| text.parse().ok()).unwrap_or(0)
    }

    /// A point that it must have, whose x has this code.
    ///
    /// # Errors
    /// There is none.
    pub fn point(&self, code: i32) -> Result<Point, String> {
        Ok(Point::new(self.needed(code)?, self.needed(code + 10)?))
    }

    /// All numbers with a code.
    ///
    /// # Errors
    /// One is no number.
    pub fn numbers(&self, code: i32) -> Result<Vec<f64>, String> {
        self.groups.iter().filter(|group| group.code == code).map(Group::number).collect()
    }
}
