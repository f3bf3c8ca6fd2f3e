//! The report as JUnit XML.

use std::collections::BTreeMap;

use crate::check::{Finding, Report};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use super::super::{Failure, printable};
use super::left_out::not_compared;

/// The report as JUnit XML: a suite for each family with findings, with a case for each location, and a passing case
/// for everything else.
pub fn text(report: &Report) -> Result<String, Failure> {
    let mut families: BTreeMap<&str, BTreeMap<String, Vec<&Finding>>> = BTreeMap::new();
    for finding in &report.findings {
        let cases = families.entry(&finding.location.family).or_default();
        cases.entry(finding.location.to_string()).or_default().push(finding);
    }
    let has_difference = |findings: &Vec<&Finding>| findings.iter().any(|finding| finding.change.is_difference());
    let failures: usize =
        families.values().flat_map(BTreeMap::values).filter(|findings| has_difference(findings)).count();
    let cases: usize = families.values().map(BTreeMap::len).sum();
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let suites = with_counts(BytesStart::new("testsuites"), "coupler-atlas check", cases + 1, failures);
    writer.write_event(Event::Start(suites))?;
    for (family, cases) in &families {
        let failed = cases.values().filter(|findings| has_difference(findings)).count();
        let name = if family.is_empty() { "atlas" } else { family };
        writer.write_event(Event::Start(with_counts(BytesStart::new("testsuite"), name, cases.len(), failed)))?;
        for (location, findings) in cases {
            write_case(&mut writer, name, location, findings)?;
        }
        writer.write_event(Event::End(BytesEnd::new("testsuite")))?;
    }
    writer.write_event(Event::Start(with_counts(BytesStart::new("testsuite"), "all else", 1, 0)))?;
    let checked = format!("{} curves on {} pages of {} families", report.curves, report.pages, report.families);
    write_case(&mut writer, "all else", &checked, &[])?;
    if let Some(words) = not_compared(&report.left_out) {
        writer.write_event(Event::Start(BytesStart::new("system-out")))?;
        writer.write_event(Event::Text(BytesText::new(&words)))?;
        writer.write_event(Event::End(BytesEnd::new("system-out")))?;
    }
    writer.write_event(Event::End(BytesEnd::new("testsuite")))?;
    writer.write_event(Event::End(BytesEnd::new("testsuites")))?;
    Ok(String::from_utf8(writer.into_inner()).map_err(Failure::system)? + "\n")
}

fn with_counts<'a>(mut start: BytesStart<'a>, name: &str, tests: usize, failures: usize) -> BytesStart<'a> {
    start.push_attribute(("name", printable(name).as_str()));
    start.push_attribute(("tests", tests.to_string().as_str()));
    start.push_attribute(("failures", failures.to_string().as_str()));
    start
}

fn write_case(
    writer: &mut Writer<Vec<u8>>,
    family: &str,
    location: &str,
    findings: &[&Finding],
) -> Result<(), Failure> {
    let mut start = BytesStart::new("testcase");
    start.push_attribute(("classname", printable(family).as_str()));
    start.push_attribute(("name", printable(location).as_str()));
    writer.write_event(Event::Start(start))?;
    let texts = |is_difference: bool| -> Vec<String> {
        let matching = findings.iter().filter(|finding| finding.change.is_difference() == is_difference);
        matching.map(|finding| format!("{}: {}", finding.change.kind(), printable(&finding.change))).collect()
    };
    for (name, texts) in [("failure", texts(true)), ("system-out", texts(false))] {
        let Some(first) = texts.first() else { continue };
        let mut start = BytesStart::new(name);
        if name == "failure" {
            start.push_attribute(("message", first.as_str()));
        }
        writer.write_event(Event::Start(start))?;
        writer.write_event(Event::Text(BytesText::new(&texts.join("\n"))))?;
        writer.write_event(Event::End(BytesEnd::new(name)))?;
    }
    writer.write_event(Event::End(BytesEnd::new("testcase")))?;
    Ok(())
}
