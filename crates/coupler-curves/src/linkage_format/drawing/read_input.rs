//! Reads the input of a drawing.

use super::read::Reader;
use super::{DrawnInput, DrawnLink, FLOATING_INPUT, Slide};
use crate::linkage_format::fields::Fields;
use crate::linkage_format::joint_values::{parse_joint_pair, parse_joint_ref};
use crate::linkage_format::toml_parser::{TomlParser, TomlValue};
use crate::problem::Problem;

impl Reader<'_, '_> {
    /// What is driven: a link on the frame, an angle between links, the way of a slider, or a distance.
    pub fn input<'t>(
        &self,
        value: &TomlValue<'t>,
        links: &[DrawnLink],
        slides: &[Slide],
        parser: &mut TomlParser<'t>,
    ) -> Option<DrawnInput> {
        if value.get_ref().as_table().is_none() {
            let line = self.line(value, parser)?;
            let link = self.link_with(line, links, value, parser)?;
            return self.crank(line, link, links, value, parser);
        }
        let fields = Fields::from_value(value, &FLOATING_INPUT, parser)?;
        match (fields.get("between"), fields.get("slider"), fields.get("distance")) {
            (Some(between), None, None) => {
                let [first, second] = parser.pair(between, "[\"A B\", \"B C\"]")?;
                let (from, to) = (self.line(first, parser), self.line(second, parser));
                let (from, to) = (from?, to?);
                let ground = self.link_with(from, links, first, parser);
                let link = self.link_with(to, links, second, parser);
                let (ground, link) = (ground?, link?);
                if ground == link {
                    let problem = Problem::error(between.span(), "both lines are on one link");
                    parser.report(problem.with_help("name lines of two links"));
                    return None;
                }
                let common = links[ground].joints.iter().copied().find(|joint| links[link].joints.contains(joint));
                let Some(pivot) = common else {
                    return Some(DrawnInput::Crank { ground, from: Some(from), link, line: to });
                };
                match to.iter().find(|joint| **joint != pivot) {
                    Some(&other) if to.contains(&pivot) => {
                        Some(DrawnInput::Crank { ground, from: Some(from), link, line: [pivot, other] })
                    }
                    _ => {
                        let name = self.names.all()[pivot];
                        let problem = Problem::error(
                            second.span(),
                            format!("the line does not begin at `{name}`, about which its link turns"),
                        );
                        parser.report(problem.with_help(format!("name `{name}` and another joint of that link")));
                        None
                    }
                }
            }
            (None, Some(slider), None) => {
                let joint = parse_joint_ref(slider, self.names, parser)?;
                let found = slides.iter().position(|slide| slide.joint == joint);
                if found.is_none() {
                    let name = self.names.all()[joint];
                    let problem = Problem::error(slider.span(), format!("`{name}` does not slide"));
                    parser.report(
                        problem.with_help(format!("give it a line, as in slides = {{ {name} = [\"P\", \"Q\"] }}")),
                    );
                }
                found.map(|slide| DrawnInput::Slider { ground: slides[slide].link, slide })
            }
            (None, None, Some(distance)) => {
                let [a, b] = parse_joint_pair(distance, self.names, parser)?;
                let candidates = || {
                    let with =
                        move |joint: usize| (0..links.len()).filter(move |&link| links[link].joints.contains(&joint));
                    with(a)
                        .flat_map(move |first| with(b).map(move |second| [first, second]))
                        .filter(|[first, second]| first != second)
                };
                let common = |[first, second]: [usize; 2]| {
                    links[first]
                        .joints
                        .iter()
                        .copied()
                        .find(|joint| links[second].joints.contains(joint) && *joint != a && *joint != b)
                };
                let found = candidates().find_map(|pair| Some((pair, common(pair)?)));
                let Some(([first, second], pivot)) = found else {
                    let is_one_link = links.iter().any(|link| link.joints.contains(&a) && link.joints.contains(&b));
                    if !is_one_link {
                        return Some(DrawnInput::Distance { joints: [a, b] });
                    }
                    let [a, b] = [a, b].map(|joint| self.names.all()[joint]);
                    let problem = Problem::error(
                        distance.span(),
                        format!("`{a}` and `{b}` are on one link, and their distance does not change"),
                    );
                    parser.report(problem.with_help("an actuator is between two links: name a joint of each"));
                    return None;
                };
                // The frame is at rest if it is one of the two.
                Some(match second {
                    0 => DrawnInput::Actuator { ground: second, link: first, joints: [b, a, pivot] },
                    _ => DrawnInput::Actuator { ground: first, link: second, joints: [a, b, pivot] },
                })
            }
            (between, slider, distance) => {
                let is_given = [between, slider, distance].iter().any(Option::is_some);
                let what = if is_given {
                    "an input has one of `between`, `slider` and `distance`"
                } else {
                    "the input is not said"
                };
                let problem = Problem::error(value.span(), what);
                parser.report(problem.with_help("write a link on the frame, as in \"O A\", { between = [\"A B\", \"B C\"] }, { slider = \"S\" } or { distance = [\"O\", \"B\"] }"));
                None
            }
        }
    }

    /// A link on the frame that is driven.
    fn crank<'t>(
        &self,
        [a, b]: [usize; 2],
        link: usize,
        links: &[DrawnLink],
        value: &TomlValue<'t>,
        parser: &mut TomlParser<'t>,
    ) -> Option<DrawnInput> {
        let is_fixed = |joint: usize| links[0].joints.contains(&joint);
        let line = match (is_fixed(a), is_fixed(b)) {
            _ if link == 0 => None,
            (true, false) => Some([a, b]),
            (false, true) => Some([b, a]),
            _ => None,
        };
        if line.is_none() {
            let fixed: Vec<String> =
                links[0].joints.iter().map(|&joint| format!("`{}`", self.names.all()[joint])).collect();
            let text = format!("{} {}", self.names.all()[a], self.names.all()[b]);
            let problem =
                Problem::error(value.span(), format!("`{text}` is not a link that turns about a fixed joint"));
            parser.report(problem.with_help(format!(
                "name a fixed joint, {}, and another joint of a link there; the angle between two moving links is {{ between = [\"A B\", \"B C\"] }}",
                fixed.join(" or ")
            )));
        }
        line.map(|line| DrawnInput::Crank { ground: 0, from: None, link, line })
    }
}
