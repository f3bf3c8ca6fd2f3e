//! A minimal reader of PDF for the tests: objects by the cross-reference table, page contents by their operators, text
//! by the fonts' own Unicode tables.

use std::collections::BTreeMap;
use std::io::Read;

use flate2::read::ZlibDecoder;

/// Millimetres to a point.
const MM: f64 = 25.4 / 72.0;

/// A file, as the dictionary and the stream of each object, by the object's number.
pub struct Pdf {
    objects: BTreeMap<usize, (String, Vec<u8>)>,
    pub catalog: usize,
}

/// A polyline, in millimetres from the upper left corner of the page; curves have their control points.
pub type PolylineMm = Vec<[f64; 2]>;

/// What is drawn on a page.
#[derive(Default, Debug)]
pub struct Contents {
    /// The paths, each with its operator (`S`, `f`, `B`) and the width of its line in millimetres.
    pub paths: Vec<(Vec<PolylineMm>, String, f64)>,
    /// The texts: their characters, and in millimetres their starts and their directions, as long as their size.
    pub texts: Vec<(String, [f64; 2], [f64; 2])>,
}

impl Pdf {
    pub fn read(bytes: &[u8]) -> Pdf {
        let tail = String::from_utf8_lossy(&bytes[bytes.len() - 400..]).into_owned();
        let table: usize = after(&tail, "startxref\n").parse().unwrap();
        let text = String::from_utf8_lossy(&bytes[table..]).into_owned();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("xref"));
        let count: usize = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
        let mut objects = BTreeMap::new();
        for (number, line) in lines.take(count).enumerate().filter(|(_, line)| line.trim_end().ends_with('n')) {
            let at: usize = line[..10].parse().unwrap();
            objects.insert(number, object(&bytes[at..], number));
        }
        Pdf { objects, catalog: after(&tail, "/Root ").parse().unwrap() }
    }

    pub fn dictionary(&self, number: usize) -> &str {
        &self.objects[&number].0
    }

    /// The object a dictionary's entry refers to.
    pub fn refer(&self, dictionary: &str, key: &str) -> usize {
        after(dictionary, &format!("/{key} ")).parse().unwrap_or_else(|_| panic!("no {key} in {dictionary}"))
    }

    /// The numbers of the pages' objects.
    pub fn pages(&self) -> Vec<usize> {
        let tree = self.dictionary(self.refer(self.dictionary(self.catalog), "Pages"));
        references(tree.split("/Kids").nth(1).unwrap())
    }

    /// The links of a page: their boxes in points, and the index of the page each leads to.
    pub fn links(&self, page: usize) -> Vec<([f64; 4], usize)> {
        let pages = self.pages();
        let Some(list) = self.dictionary(pages[page]).split("/Annots").nth(1) else { return Vec::new() };
        let link = |annotation: usize| {
            let dictionary = self.dictionary(annotation);
            let corners: Vec<f64> = numbers(between(dictionary, "/Rect[", "]"));
            (corners.try_into().unwrap(), self.target_page(dictionary))
        };
        // The others lead to addresses.
        let leads_to_page = |annotation: &usize| self.dictionary(*annotation).contains("/Dest");
        references(list).into_iter().filter(leads_to_page).map(link).collect()
    }

    /// The outline's entries: their depth, their title and the index of the page each leads to.
    pub fn outline(&self) -> Vec<(usize, String, usize)> {
        let mut found = Vec::new();
        let root = self.dictionary(self.refer(self.dictionary(self.catalog), "Outlines"));
        self.entries(root, 0, &mut found);
        found
    }

    fn entries(&self, parent: &str, depth: usize, found: &mut Vec<(usize, String, usize)>) {
        let mut next = parent.contains("/First ").then(|| self.refer(parent, "First"));
        while let Some(entry) = next {
            let dictionary = self.dictionary(entry);
            found.push((depth, string(between(dictionary, "/Title", "/Dest")), self.target_page(dictionary)));
            self.entries(dictionary, depth + 1, found);
            next = dictionary.contains("/Next ").then(|| self.refer(dictionary, "Next"));
        }
    }

    /// The index of the page that a link or an outline entry leads to.
    fn target_page(&self, dictionary: &str) -> usize {
        let destination = self.dictionary(self.refer(dictionary, "Dest"));
        self.pages().iter().position(|page| *page == references(destination)[0]).unwrap()
    }

    /// The pages' labels: style and number.
    pub fn labels(&self) -> Vec<String> {
        let tree = self.dictionary(self.refer(self.dictionary(self.catalog), "PageLabels"));
        references(tree).into_iter().map(|label| self.dictionary(label).replace(char::is_whitespace, "")).collect()
    }

    /// What is drawn on a page.
    pub fn contents(&self, page: usize) -> Contents {
        let dictionary = self.dictionary(self.pages()[page]);
        let height = numbers(between(dictionary, "/MediaBox[", "]"))[3];
        let stream = &self.objects[&self.refer(dictionary, "Contents")].1;
        let resources = dictionary.split("/Resources").nth(1).unwrap();
        let resources = match references(resources).first() {
            Some(&own) if !resources.trim_start().starts_with("<<") => self.dictionary(own),
            _ => resources,
        };
        let mut fonts = BTreeMap::new();
        if let Some(list) = resources.split("/Font").nth(1) {
            for entry in between(list, "<<", ">>").split('/').skip(1) {
                let (name, font) = entry.split_once(' ').unwrap();
                fonts.insert(name.to_owned(), self.unicode(references(font)[0]));
            }
        }
        Interpreter { height, fonts, ..Interpreter::default() }.run(stream)
    }

    /// The characters of each glyph of a font.
    fn unicode(&self, font: usize) -> BTreeMap<u16, String> {
        let map =
            String::from_utf8_lossy(&self.objects[&self.refer(self.dictionary(font), "ToUnicode")].1).into_owned();
        let mut characters = BTreeMap::new();
        for line in map.lines().filter(|line| line.starts_with('<')) {
            let parts: Vec<&str> = line.split(['<', '>']).filter(|part| !part.trim().is_empty()).collect();
            if let [glyph, text] = parts[..] {
                let units: Vec<u16> = (0..text.len() / 4).map(|k| hex(&text[4 * k..4 * k + 4])).collect();
                characters.insert(hex(glyph), String::from_utf16(&units).unwrap());
            }
        }
        characters
    }

    /// The descriptors of all fonts.
    pub fn fonts(&self) -> Vec<&str> {
        let all = self.objects.values().map(|(dictionary, _)| dictionary.as_str());
        all.filter(|dictionary| dictionary.contains("/Type/FontDescriptor")).collect()
    }
}

/// An element of the structure of a book.
#[derive(Debug, Default)]
pub struct Element {
    pub kind: String,
    /// Its title, or what is said in its place.
    pub says: String,
    pub children: Vec<Element>,
    /// The number of pieces of content that are directly in it.
    pub contents: usize,
    /// The number of annotations that are directly in it.
    pub objects: usize,
}

impl Pdf {
    /// The structure, which is one element.
    pub fn structure(&self) -> Element {
        let root = self.dictionary(self.refer(self.dictionary(self.catalog), "StructTreeRoot"));
        self.element(references(root.split("/K").nth(1).unwrap())[0])
    }

    fn element(&self, number: usize) -> Element {
        let dictionary = self.dictionary(number);
        let kind = between(dictionary, "/S/", "/").to_owned();
        let said = ["/T", "/Alt"].into_iter().filter_map(|key| {
            ["(", "<"].into_iter().find_map(|quote| {
                let (_, rest) = dictionary.split_once(&format!("{key}{quote}"))?;
                let end = if quote == "<" { rest.find('>')? } else { literal(format!("({rest}").as_bytes()).1 - 2 };
                Some(string(&format!("{quote}{}{}", &rest[..end], if quote == "(" { ")" } else { "" })))
            })
        });
        let says = said.collect::<String>();
        let list = dictionary.rsplit_once("/K[").map_or("", |(_, rest)| rest.split(']').next().unwrap());
        // What refers to annotations are dictionaries.
        let mut plain = list.to_owned();
        let mut objects = 0;
        while let (Some(from), Some(to)) = (plain.find("<<"), plain.find(">>")) {
            objects += usize::from(plain[from..to].contains("/OBJR"));
            plain.replace_range(from..to + 2, " ");
        }
        let children = references(&plain);
        let words = plain.split_whitespace().count();
        let contents = words - 3 * children.len();
        let children = children.into_iter().map(|child| self.element(child)).collect();
        Element { kind, says, children, contents, objects }
    }

    /// The content of a page.
    pub fn stream(&self, page: usize) -> &[u8] {
        &self.objects[&self.refer(self.dictionary(self.pages()[page]), "Contents")].1
    }

    /// The number of pieces of content of a page that are parts of the structure. All others must be marked as artifacts.
    pub fn count_parts(&self, page: usize) -> usize {
        let (mut depth, mut count) = (0, 0);
        for token in tokens(self.stream(page)) {
            let Token::Word(word) = token else { continue };
            match word.as_str() {
                "BDC" | "BMC" => depth += 1,
                "EMC" => depth -= 1,
                "/MCID" => count += 1,
                "S" | "f" | "B" | "Tj" | "TJ" => assert!(depth > 0, "unmarked content on page {page}"),
                _ => {}
            }
        }
        count
    }
}

#[derive(Default)]
struct Interpreter {
    height: f64,
    fonts: BTreeMap<String, BTreeMap<u16, String>>,
    states: Vec<([f64; 6], f64)>,
}

impl Interpreter {
    fn run(mut self, stream: &[u8]) -> Contents {
        let mut contents = Contents::default();
        let (mut matrix, mut width) = ([1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1.0);
        let (mut operands, mut lines, mut font, mut text) =
            (Vec::new(), Vec::<PolylineMm>::new(), String::new(), [0.0; 6]);
        let (mut size, mut name) = (0.0, String::new());
        let mut shown: Vec<u8> = Vec::new();
        let mm = |matrix: &[f64; 6], x: f64, y: f64, height: f64| {
            let [a, b, c, d, e, f] = *matrix;
            [(a * x + c * y + e) * MM, (height - (b * x + d * y + f)) * MM]
        };
        for token in tokens(stream) {
            let word = match token {
                Token::String(bytes) => {
                    shown.extend(bytes);
                    continue;
                }
                Token::Word(word) => word,
            };
            if let Ok(number) = word.parse::<f64>() {
                operands.push(number);
                continue;
            }
            match word.as_str() {
                "q" => self.states.push((matrix, width)),
                "Q" => (matrix, width) = self.states.pop().unwrap(),
                "cm" => matrix = times(&operands, &matrix),
                "w" => width = operands[0],
                "m" => lines.push(vec![mm(&matrix, operands[0], operands[1], self.height)]),
                "l" | "c" => {
                    let line = lines.last_mut().unwrap();
                    line.extend(operands.chunks(2).map(|p| mm(&matrix, p[0], p[1], self.height)));
                }
                "S" | "f" | "B" => {
                    let scale = (matrix[0] * matrix[3] - matrix[1] * matrix[2]).abs().sqrt();
                    contents.paths.push((std::mem::take(&mut lines), word.clone(), width * scale * MM));
                }
                "Tm" => text = times(&operands, &matrix),
                "Tf" => (size, font) = (operands[0], name.clone()),
                // The strings of marked-content operators are not drawn.
                "BDC" => shown.clear(),
                "TJ" | "Tj" => {
                    let glyphs = shown.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
                    let font = &self.fonts[&font];
                    let text_shown =
                        glyphs.map(|glyph| font.get(&glyph).cloned().unwrap_or("\u{fffd}".into())).collect();
                    let (start, end) = (mm(&text, 0.0, 0.0, self.height), mm(&text, size, 0.0, self.height));
                    contents.texts.push((text_shown, start, [end[0] - start[0], end[1] - start[1]]));
                    shown.clear();
                }
                word if word.starts_with('/') => word[1..].clone_into(&mut name),
                _ => {}
            }
            if !word.starts_with('/') {
                operands.clear();
            }
        }
        contents
    }
}

/// The product of two matrices: the first is applied first, then the other.
fn times(first: &[f64], then: &[f64; 6]) -> [f64; 6] {
    let [a, b, c, d, e, f] = <[f64; 6]>::try_from(first).unwrap();
    let [p, q, r, s, t, u] = *then;
    [a * p + b * r, a * q + b * s, c * p + d * r, c * q + d * s, e * p + f * r + t, e * q + f * s + u]
}

enum Token {
    Word(String),
    String(Vec<u8>),
}

fn tokens(stream: &[u8]) -> Vec<Token> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < stream.len() {
        match stream[at] {
            b'(' => {
                let (string, end) = literal(&stream[at..]);
                found.push(Token::String(string));
                at += end;
            }
            // A dictionary, such as that of marked content.
            b'<' if stream.get(at + 1) == Some(&b'<') => at += 2,
            b'<' => {
                let end = at + stream[at..].iter().position(|b| *b == b'>').unwrap();
                let digits = std::str::from_utf8(&stream[at + 1..end]).unwrap();
                found
                    .push(Token::String((0..digits.len() / 2).map(|k| hex(&digits[2 * k..2 * k + 2]) as u8).collect()));
                at = end + 1;
            }
            b' ' | b'\n' | b'\r' | b'[' | b']' | b'>' => at += 1,
            _ => {
                let ends = |b: &u8| b" \n\r[]()<>".contains(b);
                let length =
                    1 + stream[at + 1..].iter().position(|b| ends(b) || *b == b'/').unwrap_or(stream.len() - at - 1);
                found.push(Token::Word(String::from_utf8(stream[at..at + length].to_vec()).unwrap()));
                at += length;
            }
        }
    }
    found
}

/// The bytes of a string in parentheses, and its length including them.
fn literal(stream: &[u8]) -> (Vec<u8>, usize) {
    let (mut bytes, mut depth, mut at) = (Vec::new(), 0, 0);
    loop {
        match stream[at] {
            b'(' => {
                depth += 1;
                if depth > 1 {
                    bytes.push(b'(');
                }
            }
            b')' => {
                depth -= 1;
                if depth == 0 {
                    return (bytes, at + 1);
                }
                bytes.push(b')');
            }
            b'\\' => {
                at += 1;
                match stream[at] {
                    b'n' => bytes.push(b'\n'),
                    b'r' => bytes.push(b'\r'),
                    b't' => bytes.push(b'\t'),
                    b'b' => bytes.push(8),
                    b'f' => bytes.push(12),
                    b'0'..=b'7' => {
                        let digits = std::str::from_utf8(&stream[at..at + 3]).unwrap();
                        bytes.push(u8::from_str_radix(digits, 8).unwrap());
                        at += 2;
                    }
                    other => bytes.push(other),
                }
            }
            other => bytes.push(other),
        }
        at += 1;
    }
}

/// A string of a dictionary: ASCII, or UTF-16 after a byte order mark.
fn string(text: &str) -> String {
    let bytes = match text.trim().strip_prefix('<') {
        Some(digits) => (0..digits.len() / 2).map(|k| hex(&digits[2 * k..2 * k + 2]) as u8).collect(),
        None => literal(text.trim().as_bytes()).0,
    };
    match bytes.strip_prefix(&[0xfe, 0xff]) {
        Some(wide) => {
            let units: Vec<u16> = wide.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            String::from_utf16(&units).unwrap()
        }
        None => String::from_utf8(bytes).unwrap(),
    }
}

/// The dictionary and the decompressed stream of the object at the start of the bytes.
fn object(bytes: &[u8], number: usize) -> (String, Vec<u8>) {
    let head = format!("{number} 0 obj\n");
    assert!(bytes.starts_with(head.as_bytes()), "object {number} is not where the table says");
    let find = |word: &[u8]| bytes.windows(word.len()).position(|window| window == word);
    let end = find(b"endobj").unwrap();
    match find(b"\nstream\n").filter(|at| *at < end) {
        None => (String::from_utf8_lossy(&bytes[head.len()..end]).into_owned(), Vec::new()),
        Some(at) => {
            let dictionary = String::from_utf8(bytes[head.len()..at].to_vec()).unwrap();
            let length: usize = after(&dictionary, "/Length ").parse().unwrap();
            let data = &bytes[at + 8..at + 8 + length];
            let mut plain = data.to_vec();
            if dictionary.contains("/FlateDecode") {
                plain.clear();
                ZlibDecoder::new(data).read_to_end(&mut plain).unwrap();
            }
            (dictionary, plain)
        }
    }
}

/// The digits after a word.
fn after<'t>(text: &'t str, word: &str) -> &'t str {
    let rest = text.split(word).nth(1).unwrap_or_default();
    &rest[..rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())]
}

/// The text between two words.
fn between<'t>(text: &'t str, from: &str, to: &str) -> &'t str {
    text.split(from).nth(1).unwrap().split(to).next().unwrap()
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

/// The objects referred to in an array, up to its end.
fn references(text: &str) -> Vec<usize> {
    let list = text.split(']').next().unwrap();
    let words: Vec<&str> = list.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let referred = |three: &[&str]| (three[1] == "0" && three[2] == "R").then(|| three[0].parse().unwrap());
    words.windows(3).filter_map(referred).collect()
}

fn hex(digits: &str) -> u16 {
    u16::from_str_radix(digits, 16).unwrap()
}
