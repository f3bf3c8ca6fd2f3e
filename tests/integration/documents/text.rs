//! Blocks of code, prose and code in prose of a document in Markdown, as far as the documents use it.

pub struct Document {
    pub name: String,
    pub blocks: Vec<Block>,
    pub prose: Vec<Prose>,
}

/// A block of code between fences, or indented by four blanks.
pub struct Block {
    /// The number of its first line.
    pub line: usize,
    /// The word after the fence; empty for an indented block.
    pub language: String,
    pub text: String,
}

/// A heading, a paragraph, an item of a list or a row of a table.
pub struct Prose {
    pub line: usize,
    /// The title of the section.
    pub section: String,
    /// The first row of the table.
    pub table: Option<String>,
    pub text: String,
}

impl Document {
    pub fn parse(name: String, text: &str) -> Document {
        let mut document = Document { name, blocks: Vec::new(), prose: Vec::new() };
        let (mut section, mut table, mut is_open) = (String::new(), None, false);
        let mut lines = text.lines().enumerate().map(|(k, line)| (k + 1, line)).peekable();
        while let Some((number, line)) = lines.next() {
            let trimmed = line.trim_start();
            let indent = line.len() - trimmed.len();
            if let Some(language) = trimmed.strip_prefix("```") {
                let inside = lines.by_ref().map(|(_, line)| line).take_while(|line| line.trim() != "```");
                let text = inside.map(|line| line.get(indent..).unwrap_or("").to_owned() + "\n").collect();
                document.blocks.push(Block { line: number, language: language.to_owned(), text });
                is_open = false;
            } else if trimmed.is_empty() {
                (is_open, table) = (false, None);
            } else if indent >= 4 && !is_open {
                let mut text = line[4..].to_owned() + "\n";
                while let Some((_, line)) = lines.next_if(|(_, line)| line.starts_with("    ")) {
                    text += &(line[4..].to_owned() + "\n");
                }
                document.blocks.push(Block { line: number, language: String::new(), text });
            } else {
                if trimmed.starts_with('#') {
                    section = trimmed.trim_start_matches('#').trim().to_owned();
                }
                let is_row = trimmed.starts_with('|');
                if is_row && table.is_none() {
                    table = Some(trimmed.to_owned());
                }
                let is_item =
                    trimmed.starts_with("- ") || trimmed.split_once(". ").is_some_and(|(n, _)| n.parse::<u8>().is_ok());
                if is_open && !is_row && !is_item {
                    let last = &mut document.prose.last_mut().unwrap().text;
                    *last = format!("{last} {trimmed}");
                } else {
                    let (section, table) = (section.clone(), table.clone().filter(|_| is_row));
                    document.prose.push(Prose { line: number, section, table, text: trimmed.to_owned() });
                }
                is_open = !is_row && !trimmed.starts_with('#');
            }
        }
        document
    }

    /// The first cells of the rows of the tables in a section that begin with a word, without their headings.
    pub fn first_cells(&self, section: &str, heading: &str) -> Vec<String> {
        let start = format!("| {heading} |");
        let rows = self.prose.iter().filter(|prose| {
            prose.section == section && prose.table.as_ref().is_some_and(|table| table.starts_with(&start))
        });
        let cells: Vec<String> = rows.map(|row| row.first_cell()).filter(|cell| cell.starts_with('`')).collect();
        assert!(!cells.is_empty(), "{} has no table of {heading} in {section}", self.name);
        cells
    }
}

impl Prose {
    pub fn first_cell(&self) -> String {
        self.text.replace("\\|", "\u{0}").split('|').nth(1).unwrap().trim().replace('\u{0}', "|")
    }

    /// Its code.
    pub fn codes(&self) -> Vec<String> {
        codes(&self.text.replace("\\|", "|"))
    }
}

/// The texts between backticks, with single blanks.
///
/// # Panics
///
/// If a backtick has no partner.
pub fn codes(text: &str) -> Vec<String> {
    let parts: Vec<&str> = text.split('`').collect();
    assert!(parts.len() % 2 == 1, "a backtick without a partner: {text}");
    parts.iter().skip(1).step_by(2).map(|code| code.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

#[test]
fn documents_are_parsed() {
    let text = "# A\n\nOne `two\nthree` four\n- `x` five\n\n| a | b |\n|---|---|\n| `c \\| d`, `e` | `f` |\n\n## B\n\n    $ g\n      h\n\n   ```toml\n   i = 1\n\n   j = 2\n   ```\n";
    let document = Document::parse("T".into(), text);
    let blocks: Vec<_> = document.blocks.iter().map(|block| (block.line, &*block.language, &*block.text)).collect();
    assert_eq!(blocks, [(13, "", "$ g\n  h\n"), (16, "toml", "i = 1\n\nj = 2\n")]);
    let codes: Vec<_> = document.prose.iter().flat_map(Prose::codes).collect();
    assert_eq!(codes, ["two three", "x", "c | d", "e", "f"]);
    assert_eq!(document.first_cells("A", "a"), ["`c | d`, `e`"]);
    assert_eq!(document.prose.last().unwrap().section, "B");
}
