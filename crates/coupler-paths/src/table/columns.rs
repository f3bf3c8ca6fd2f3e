//! Which columns of a table are the coordinates of a path.

use super::name::ColumnName;

/// The columns with the points of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Columns {
    pub x: usize,
    pub y: usize,
    /// The column of the angle of the crank.
    pub angle: Option<usize>,
}

/// The names of all columns.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub names: Vec<ColumnName>,
    /// What stands above each, in a line of titles.
    pub titles: Vec<String>,
}

impl Header {
    /// The names in some cells; `None` if none of them are those of coordinates.
    pub fn parse(cells: &[String]) -> Option<Header> {
        let names: Vec<ColumnName> = cells.iter().map(|cell| ColumnName::new(cell)).collect();
        let header = Header { names, titles: Vec::new() };
        let is_text = cells.iter().all(|cell| ColumnName::is_name(cell));
        (is_text && !header.coordinates().is_empty()).then_some(header)
    }

    /// The columns with the letter in their names, those whose names are most surely so.
    fn with_letter(&self, letter: char, rank: u8) -> Vec<usize> {
        let ranks = self.names.iter().map(|name| name.coordinate_rank(letter));
        ranks.enumerate().filter(|(_, found)| *found == Some(rank)).map(|(k, _)| k).collect()
    }

    /// The columns of x and y of each path: pairs of them, or one x with all columns that have no other meaning, as Engauge writes them.
    pub fn coordinates(&self) -> Vec<[usize; 2]> {
        for rank in 0..3 {
            let [xs, ys] = ['x', 'y'].map(|letter| self.with_letter(letter, rank));
            if xs.len() == ys.len() && !xs.is_empty() {
                // What may be velocities is a path among others, of which one is chosen.
                if xs.iter().all(|x| self.names[*x].may_be_derived()) {
                    return Vec::new();
                }
                return xs.into_iter().zip(ys).map(|(x, y)| [x, y]).collect();
            }
            if let ([x], [_, ..]) = (&xs[..], &ys[..]) {
                return ys.iter().map(|y| [*x, *y]).collect();
            }
        }
        let is_other = |name: &ColumnName| {
            name.angle_rank().is_none()
                && !name.is_count()
                && ['x', 'y'].iter().all(|c| name.coordinate_rank(*c).is_none())
        };
        match (&self.with_letter('x', 0)[..], self.with_letter('y', 0).len()) {
            ([0], 0) if self.names[1..].iter().all(is_other) => (1..self.names.len()).map(|y| [0, y]).collect(),
            _ => Vec::new(),
        }
    }

    /// The columns whose names are most surely that of the angle of the crank.
    pub fn angles(&self) -> Vec<usize> {
        let ranks: Vec<Option<u8>> = self.names.iter().map(ColumnName::angle_rank).collect();
        let Some(best) = ranks.iter().flatten().min() else { return Vec::new() };
        (0..ranks.len()).filter(|k| ranks[*k].as_ref() == Some(best)).collect()
    }

    /// The column with this name and no other word.
    pub fn column(&self, word: &str) -> Option<usize> {
        self.names.iter().position(|name| name.is(word))
    }

    /// Takes units from the line below the names, if it has nothing else.
    pub fn take_units(&mut self, cells: &[String]) -> bool {
        let bare = |cell: &String| cell.trim_matches(['[', ']', '(', ')']).trim().to_lowercase();
        let is_unit = |cell: &String| cell.chars().count() <= 10 && cell.chars().all(|c| !c.is_numeric());
        if cells.len() > self.names.len() || !cells.iter().all(is_unit) || Header::parse(cells).is_some() {
            return false;
        }
        for (name, cell) in self.names.iter_mut().zip(cells) {
            name.unit = Some(bare(cell)).filter(|unit| !unit.is_empty()).or(name.unit.take());
        }
        true
    }

    /// Takes the titles of paths from the line above the names.
    pub fn take_titles(&mut self, cells: &[String]) {
        self.titles = cells.to_vec();
    }

    /// What the path of two columns is called: the title above them, or what the names of both have besides their letters, or the name of y.
    pub fn id(&self, [x, y]: [usize; 2]) -> String {
        let title = [x, y].into_iter().find_map(|k| self.titles.get(k).filter(|title| !title.is_empty()));
        let common = || {
            let [of_x, of_y] = [(x, 'x'), (y, 'y')].map(|(k, letter)| self.names[k].without_coordinate(letter));
            of_y.filter(|name| of_x == Some(name))
        };
        title.map(String::as_str).or_else(common).unwrap_or(&self.names[y].text).to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_known_by_their_names() {
        for (line, pairs) in [
            ("x,y", vec![[0, 1]]),
            ("y,x", vec![[1, 0]]),
            ("t,x,y,v_x,v_y", vec![[1, 2]]),
            ("Time (ms),Trajectory 1 X,Trajectory 1 Y", vec![[1, 2]]),
            ("X,Y,X,Y", vec![[0, 1], [2, 3]]),
            ("x1,y1,x2,y2", vec![[0, 1], [2, 3]]),
            ("A_x,A_y,B_x,B_y", vec![[0, 1], [2, 3]]),
            ("pos_x,pos_y,v_x,v_y", vec![[0, 1], [2, 3]]),
            ("x,y,a_x,a_y", vec![[0, 1]]),
            ("v_x,v_y", vec![]),
            ("x,y1,y2", vec![]),
            ("x,Curve1", vec![[0, 1]]),
            ("x,Curve1,Curve2", vec![[0, 1], [0, 2]]),
            ("x,angle", vec![]),
            ("t,x", vec![]),
            ("a,b", vec![]),
        ] {
            let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            let found = Header::parse(&cells).map_or(Vec::new(), |header| header.coordinates());
            assert_eq!(found, pairs, "{line}");
        }
    }

    #[test]
    fn a_path_has_the_name_that_its_columns_share() {
        for (line, ids) in [
            ("a x,a y,b x,b y", vec!["a", "b"]),
            ("A_x,A_y,B_x,B_y", vec!["A", "B"]),
            ("A.x,A.y,B.x,B.y", vec!["A", "B"]),
            ("x a,y a,x b,y b", vec!["a", "b"]),
            ("a (x),a (y),b (x),b (y)", vec!["a", "b"]),
            ("A_x [mm],A_y [mm],B_x [mm],B_y [mm]", vec!["A", "B"]),
            ("x1,y1,x2,y2", vec!["y1", "y2"]),
            ("x_1,y_1,x_2,y_2", vec!["y_1", "y_2"]),
            ("X,Y,X,Y", vec!["Y", "Y"]),
            ("x,Curve1,Curve2", vec!["Curve1", "Curve2"]),
        ] {
            let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            let header = Header::parse(&cells).unwrap();
            let found: Vec<String> = header.coordinates().into_iter().map(|pair| header.id(pair)).collect();
            assert_eq!(found, ids, "{line}");
        }
    }
}
