//! Texts with characters that the typeface of a manifest does not have.

use coupler_curves::linkage_format::{Fields, TomlValue};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::text::is_invisible;
use coupler_drawing::scene::{FontFamily, Typeface};

/// The most texts that are reported: a remedy for one is one for all.
const MAX_PROBLEMS: usize = 10;

/// Keys whose texts are not printed: the names of files, wishes, and names that every typeface has the letters of.
const UNPRINTED: [&str; 4] = ["output", "fallback_face", "cases", "design"];

/// The texts of a manifest with characters that a typeface does not have, names of tables among them.
pub(crate) fn undrawable_texts(document: &TomlValue, typeface: Typeface) -> Vec<Problem> {
    let mut problems = Vec::new();
    collect(document, typeface, &mut problems);
    problems
}

/// Whether a manifest names a font file that could not be read, or has not been.
pub(crate) fn names_missing_font(root: &Fields, typeface: Option<Typeface>) -> bool {
    let theme = root.get("page").and_then(|page| page.get_ref().as_table()?.get("theme"));
    let names_font =
        theme.and_then(|theme| theme.get_ref().as_table()).is_some_and(|t| t.contains_key("fallback_face"));
    names_font && typeface.is_none_or(|typeface| typeface.fallback.is_none())
}

fn collect(value: &TomlValue, typeface: Typeface, problems: &mut Vec<Problem>) {
    let mut check = |text: &str, span: Span| {
        if problems.len() < MAX_PROBLEMS {
            problems.extend(problem(text, span, typeface));
        }
    };
    if let Some(text) = value.get_ref().as_str() {
        check(text, value.span());
    } else if let Some(items) = value.get_ref().as_array() {
        items.iter().for_each(|item| collect(item, typeface, problems));
    } else if let Some(table) = value.get_ref().as_table() {
        for (key, value) in table.iter().filter(|(key, _)| !UNPRINTED.contains(&key.get_ref().as_ref())) {
            if problems.len() < MAX_PROBLEMS {
                problems.extend(problem(key.get_ref(), key.span(), typeface));
            }
            collect(value, typeface, problems);
        }
    }
}

/// Whether a character has no shape: spaces, noncharacters, and those that show nothing.
fn has_no_shape(c: char) -> bool {
    let is_noncharacter = u32::from(c) & 0xfffe == 0xfffe || ('\u{fdd0}'..='\u{fdef}').contains(&c);
    c.is_whitespace() || is_noncharacter || is_invisible(c)
}

/// The problem of a text, if it has characters that a typeface does not have.
fn problem(text: &str, span: Span, typeface: Typeface) -> Option<Problem> {
    let mut missing: Vec<char> = Vec::new();
    for c in text.chars().filter(|c| !has_no_shape(*c)) {
        if !missing.contains(&c) && !typeface.can_draw(c) {
            missing.push(c);
        }
    }
    let first = *missing.first()?;
    let others = match missing.len() - 1 {
        0 => String::new(),
        1 => " and one more character".to_owned(),
        count => format!(" and {count} more characters"),
    };
    let name = FontFamily::NAMED.iter().find(|(_, family)| *family == typeface.family).map_or("", |(name, _)| name);
    let file = if typeface.fallback.is_some() { " and its fallback face have" } else { " has" };
    let message = format!("the typeface `{name}`{file} no `{first}` (U+{:04X}){others}", u32::from(first));
    let help = "PNG, PDF and outlines need a font file that has them, as in theme = { fallback_face = \"fonts/my-font.ttf\" } \
                in [page]";
    Some(Problem::error(span, message).with_help(help))
}
