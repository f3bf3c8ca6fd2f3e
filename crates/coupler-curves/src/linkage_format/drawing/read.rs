//! Reads a `[linkage.drawing]` table.

use std::collections::{HashMap, HashSet};

use super::vectors::DrawnVector;
use super::{DRAWING, Drawing, DrawnLink, Slide};
use crate::expression::{CompiledExpression, Scope};
use crate::linkage_format::fields::Fields;
use crate::linkage_format::joint_id::check_joint_id;
use crate::linkage_format::joint_values::{check_positive, parse_joint_pair, parse_joint_ref};
use crate::linkage_format::names::JointNames;
use crate::linkage_format::quantities::InputKind;
use crate::linkage_format::toml_parser::{TomlParser, TomlValue};
use crate::problem::{Problem, Span};

/// The most links and the most joints of a drawing.
const MAX_LINKS: usize = 100;
const MAX_JOINTS: usize = 1000;

/// The most names, numbers and operators of a coordinate: dimensions repeat it some ten times, and a joint may be in those of all others.
const MAX_TOKENS: usize = 100;

/// What the input of a drawing is, as far as it can be read.
pub fn input_kind(drawing: &TomlValue) -> InputKind {
    let input = drawing.get_ref().as_table().and_then(|table| table.get("input"));
    match input.map(|input| (input.get_ref().as_str(), input.get_ref().as_table())) {
        Some((Some(_), _)) => InputKind::Angle { has_slider: false },
        Some((_, Some(input))) if input.contains_key("between") => InputKind::Angle { has_slider: false },
        Some((_, Some(input))) if input.contains_key("distance") || input.contains_key("slider") => InputKind::Length,
        _ => InputKind::Unknown,
    }
}

/// Reads a drawing over the parameters in `scope`; `None` if it has a problem, which is reported.
pub fn read_drawing<'v, 't>(
    value: &'v TomlValue<'t>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<Drawing<'v>> {
    let before = parser.problem_count();
    let fields = Fields::from_value(value, &DRAWING, parser)?;
    let table = fields.required("joints", "joints = { O = [0, 0], A = [1, 0.5] }", parser)?;
    let table = Fields::with_any_keys(table, "`joints`", parser)?;
    let names = JointNames::new(table.keys());
    let mut coordinates = Vec::new();
    let mut spans = Vec::new();
    for (name, span, value) in table.entries() {
        check_joint_id(name, &span).into_iter().for_each(|problem| parser.report(problem));
        let position = parser.pair(value, "[0.6, 0.8]").map(|xy| xy.map(|c| read_coordinate(c, scope, parser)));
        if let Some([Some(x), Some(y)]) = position {
            coordinates.push(DrawnVector([x, y]));
        }
        spans.push([span, value.span()]);
    }
    let reader = Reader { names: &names, scope };
    let frame = fields.required("frame", "frame = [\"O\", \"C\"]", parser);
    let frame = frame.and_then(|value| reader.link(value, 1, parser));
    let links = fields.required("links", "links = [[\"O\", \"A\"], [\"A\", \"B\"]]", parser);
    let links: Vec<Option<DrawnLink>> = links
        .and_then(|value| parser.list(value))
        .unwrap_or_default()
        .iter()
        .map(|value| reader.link(value, 2, parser))
        .collect();
    check_size([links.len(), names.all().len()], &fields, parser);
    // What is in an entry with a syntax error is missing without a problem of its own.
    let (frame, links) = (frame?, links.into_iter().collect::<Option<Vec<DrawnLink>>>()?);
    if parser.problem_count() > before || coordinates.len() < spans.len() {
        return None;
    }
    let links = merged([frame].into_iter().chain(links).collect());
    let in_links: HashSet<usize> = links.iter().flat_map(|link| link.joints.iter().copied()).collect();
    for (joint, name) in names.all().iter().enumerate() {
        if !in_links.contains(&joint) {
            let problem = Problem::error(spans[joint][0].clone(), format!("the joint `{name}` is in no link"));
            parser.report(problem.with_help("name it in a link or in `frame`, or leave it out"));
        }
    }
    let slides = fields.get("slides").map(|value| reader.slides(value, &links, parser)).unwrap_or_default();
    let lengths = fields.get("lengths").map(|value| reader.lengths(value, &links, parser)).unwrap_or_default();
    let input_value = fields.required("input", "input = \"O A\"", parser)?;
    let input = reader.input(input_value, &links, &slides, parser);
    if parser.problem_count() > before {
        return None;
    }
    let names = names.all().to_vec();
    let (span, input_span) = (fields.span.clone(), input_value.span());
    let mut links_at = vec![Vec::new(); names.len()];
    for (k, link) in links.iter().enumerate() {
        link.joints.iter().for_each(|&joint| links_at[joint].push(k));
    }
    Some(Drawing { names, spans, coordinates, links, links_at, slides, lengths, input: input?, input_span, span })
}

/// A coordinate of a joint.
fn read_coordinate<'t>(
    value: &TomlValue<'t>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<CompiledExpression> {
    let coordinate = parser.numeric_expression(value, scope)?;
    let tokens = coordinate.token_count();
    if tokens > MAX_TOKENS {
        let message =
            format!("the coordinate has {tokens} names, numbers and operators, at most {MAX_TOKENS} are possible");
        let help = "make it a parameter, whose default or `let` is that expression";
        parser.report(Problem::error(value.span(), message).with_help(help));
        return None;
    }
    Some(coordinate)
}

/// Reports more links or joints than are placed in an instant.
fn check_size([links, joints]: [usize; 2], fields: &Fields, parser: &mut TomlParser) {
    for (key, count, limit) in [("links", links, MAX_LINKS), ("joints", joints, MAX_JOINTS)] {
        if count > limit {
            let span = fields.get(key).map_or_else(|| fields.span.clone(), TomlValue::span);
            let problem = Problem::error(span, format!("the drawing has {count} {key}, at most {limit} are possible"));
            parser.report(problem.with_help("points of a link can be joints of [linkage.joints], also as grids"));
        }
    }
}

/// Links of which two that have two joints in common are one, in the place of the first.
fn merged(links: Vec<DrawnLink>) -> Vec<DrawnLink> {
    let mut out: Vec<(DrawnLink, HashSet<usize>)> = Vec::new();
    for link in links {
        let joints = link.joints.iter().copied().collect();
        out.push((link, joints));
        // A link that has grown may have two joints in common with others.
        let mut grown = out.len() - 1;
        while let Some(other) =
            (0..out.len()).find(|&k| k != grown && out[k].1.intersection(&out[grown].1).nth(1).is_some())
        {
            let (link, joints) = out.remove(grown.max(other));
            grown = grown.min(other);
            let (into, known) = &mut out[grown];
            into.joints.extend(link.joints.into_iter().filter(|joint| !known.contains(joint)));
            known.extend(joints);
        }
    }
    out.into_iter().map(|(link, _)| link).collect()
}

/// What the values of a drawing may use.
pub(super) struct Reader<'r, 'v> {
    pub names: &'r JointNames<'v>,
    scope: &'r Scope<'r>,
}

impl Reader<'_, '_> {
    /// A link by its joints, at least so many.
    fn link<'t>(&self, value: &TomlValue<'t>, least: usize, parser: &mut TomlParser<'t>) -> Option<DrawnLink> {
        let list = parser.list(value)?;
        let joints: Vec<Option<usize>> = list.iter().map(|value| parse_joint_ref(value, self.names, parser)).collect();
        let joints: Vec<usize> = joints.into_iter().collect::<Option<_>>()?;
        let mut seen = HashSet::new();
        if let Some(k) = joints.iter().position(|joint| !seen.insert(*joint)) {
            let problem = Problem::error(list[k].span(), format!("`{}` is named twice", self.names.all()[joints[k]]));
            parser.report(problem.with_help("name each joint of a link once"));
            return None;
        }
        if joints.len() < least {
            let (what, help) = match least {
                1 => ("the frame has no joint", "name the joints that are fixed, as in frame = [\"O\", \"C\"]"),
                _ => (
                    "a link has two joints or more",
                    "name them, as in [\"A\", \"B\"]; a point of a link is one of its joints",
                ),
            };
            parser.report(Problem::error(value.span(), what).with_help(help));
            return None;
        }
        Some(DrawnLink { joints, span: value.span() })
    }

    /// Two joints in one text: "O A".
    pub fn line<'t>(&self, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<[usize; 2]> {
        let text = parser.text(value)?;
        let line = self.pair_in(&text);
        if line.is_none() && !parser.has_syntax_error() {
            self.report_no_pair(&text, value.span(), parser);
        }
        line
    }

    /// The two joints that a text names, with a blank between them; names may have blanks, too.
    fn pair_in(&self, text: &str) -> Option<[usize; 2]> {
        let splits = text.match_indices(' ').map(|(at, _)| (text[..at].trim(), text[at..].trim()));
        let pairs = splits.filter_map(|(a, b)| Some([self.names.index_of(a)?, self.names.index_of(b)?]));
        pairs.into_iter().find(|[a, b]| a != b)
    }

    /// Reports a text that does not name two joints.
    fn report_no_pair(&self, text: &str, span: Span, parser: &mut TomlParser) {
        let example = match self.names.all() {
            [a, b, ..] => [*a, *b],
            _ => ["O", "A"],
        };
        let problem = Problem::error(span, format!("`{}` does not name two joints", text.escape_debug()));
        let help = format!("name two joints of a link with a blank between them, as in \"{}\"", example.join(" "));
        parser.report(problem.with_help(help));
    }

    /// The link that has some joints; reported if there is none.
    pub fn link_with<'t>(
        &self,
        joints: [usize; 2],
        links: &[DrawnLink],
        value: &TomlValue<'t>,
        parser: &mut TomlParser<'t>,
    ) -> Option<usize> {
        let link = links.iter().position(|link| joints.iter().all(|joint| link.joints.contains(joint)));
        if link.is_none() {
            let [a, b] = joints.map(|joint| self.names.all()[joint]);
            let problem = Problem::error(value.span(), format!("no link has both `{a}` and `{b}`"));
            parser.report(problem.with_help("name two joints of one link, or add the link to `links`"));
        }
        link
    }

    fn slides<'t>(&self, value: &TomlValue<'t>, links: &[DrawnLink], parser: &mut TomlParser<'t>) -> Vec<Slide> {
        let Some(table) = Fields::with_any_keys(value, "`slides`", parser) else { return Vec::new() };
        let mut slides = Vec::new();
        for (name, span, value) in table.entries() {
            let Some(joint) = self.names.index_of(name) else {
                let problem = Problem::error(span, format!("unknown joint `{}`", name.escape_debug()));
                parser.report(problem.with_help(crate::problem::suggestion(name, self.names.all())));
                continue;
            };
            let Some(line) = parse_joint_pair(value, self.names, parser) else { continue };
            let Some(link) = self.link_with(line, links, value, parser) else { continue };
            if links[link].joints.contains(&joint) {
                let problem = Problem::error(span, format!("`{name}` slides on a line of its own link"));
                parser.report(
                    problem.with_help(
                        "name two joints of the other link, or leave the joint out of the link with the line",
                    ),
                );
                continue;
            }
            slides.push(Slide { joint, line, link });
        }
        slides
    }

    fn lengths<'t>(
        &self,
        value: &TomlValue<'t>,
        links: &[DrawnLink],
        parser: &mut TomlParser<'t>,
    ) -> HashMap<[usize; 2], CompiledExpression> {
        let Some(table) = Fields::with_any_keys(value, "`lengths`", parser) else { return HashMap::new() };
        let mut lengths = HashMap::new();
        for (text, span, value) in table.entries() {
            let Some([a, b]) = self.pair_in(text) else {
                self.report_no_pair(text, span, parser);
                continue;
            };
            let link = self.link_with([a, b], links, value, parser);
            let Some(length) = parser.numeric_expression(value, self.scope) else { continue };
            check_positive(&length, value, parser);
            if link == Some(0) {
                let problem = Problem::error(span, format!("`{text}` is a distance of the frame"));
                parser.report(problem.with_help("change the coordinates of its joints, which may use parameters"));
            }
            if lengths.insert([a.min(b), a.max(b)], length).is_some() {
                let problem = Problem::error(value.span(), format!("the distance `{text}` is given twice"));
                parser.report(problem.with_help("give it once"));
            }
        }
        lengths
    }
}
