//! Finds the best curves of complete shards.

use std::collections::{BTreeMap, BTreeSet};

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::Family;
use coupler_curves::measure;
use csv::StringRecord;
use rayon::prelude::*;

use super::super::Error;
use super::super::best::{Best, Ranked};
use super::super::expression::{check_direction, compile, is_of_circuits, own_criterion};
use super::super::read::ShardFile;
use super::super::record::Top;
use super::gathered::{BestCurve, GatherOptions};
use crate::manifest::{Plan, PlannedFamily};

/// How many of the best are found, and by which expression in each family; `None` if none are asked for.
fn ranking(gathered: &[Gathering], options: &GatherOptions) -> Result<Option<(usize, Vec<String>)>, Error> {
    let problem = |message: String| Err(Error::Problems(vec![message]));
    let recorded: Vec<&Top> = gathered.iter().filter_map(|(_, files)| files[0].record.top.as_ref()).collect();
    if let Some(first) = recorded.first() {
        let is_other = |by: &&String| recorded.iter().any(|top| top.by != by.trim());
        if let Some(by) = options.by.as_ref().filter(is_other) {
            return problem(format!("the shards have only the best by `{}`, not by `{by}`", first.by));
        }
        return match options.top {
            Some(top) if top > first.count => {
                problem(format!("the shards have only the best {}, not {top}", first.count))
            }
            top => Ok(Some((top.unwrap_or(first.count), recorded.iter().map(|top| top.by.clone()).collect()))),
        };
    }
    match (options.top, &options.by) {
        (Some(top), Some(by)) => {
            check_direction(by.trim())?;
            Ok(Some((top, vec![by.trim().to_owned(); gathered.len()])))
        }
        (Some(top), None) => {
            let own = gathered.iter().map(|(plan, _)| own_criterion(&plan.families[0]).map(|own| own.text));
            Ok(Some((top, own.collect::<Result<_, _>>()?)))
        }
        (None, Some(_)) => problem("how many are the best? Add --top, as in --top 100".to_owned()),
        (None, None) => Ok(None),
    }
}

/// The shards of a family, and the plan of its manifest.
type Gathering = (Plan, Vec<ShardFile>);

/// The place of a row: its family, cell, trace and circuit, its file and its index.
type Row = ([usize; 4], usize, usize);

/// The best curves of shards.
#[derive(Debug, Default)]
pub(super) struct Ranking {
    /// The expressions, in the order of families; none if no best are asked for.
    pub by: Vec<String>,
    /// The columns of their rows.
    pub columns: Vec<String>,
    /// The curves of each expression, best first.
    pub best: Vec<BestCurve>,
}

/// Finds the best curves of the families that are ranked by one expression together. Of a family without a name of the expression no curve is among them, and if only a measure is missing in
/// its tables, a note says so.
pub(super) fn rank(gathered: &[Gathering], options: &GatherOptions, notes: &mut Vec<String>) -> Result<Ranking, Error> {
    let Some((top, expressions)) = ranking(gathered, options)? else { return Ok(Ranking::default()) };
    // The best by each expression that a family has the names and columns of.
    let mut ranked: Vec<(&String, Best<Row>)> = Vec::new();
    let (mut failure, mut lacking) = (None, Vec::new());
    for (k, ((plan, files), by)) in gathered.iter().zip(&expressions).enumerate() {
        let expression = match compile(&plan.families[0], by) {
            Ok(expression) => expression,
            Err(message) => {
                failure.get_or_insert_with(|| Error::by(by, message));
                continue;
            }
        };
        let family = &plan.families[0].family;
        let has_column = |slot: &&usize| files[0].record.columns.iter().any(|name| name == column_name(family, **slot));
        if let Some(&slot) = expression.slots().iter().find(|slot| !has_column(slot)) {
            lacking.push(format!(
                "{} has no column `{}`: sweep it with that measure",
                family.id,
                column_name(family, slot)
            ));
            continue;
        }
        let search = |(n, file): (usize, &ShardFile)| best_of_file((k, family), (n, file), &expression, top);
        let merge = |a: Best<Row>, b: Best<Row>| Ok(a.merge(b));
        let found: Result<Best<Row>, String> =
            files.par_iter().enumerate().map(search).try_reduce(|| Best::new(top), merge);
        let found = found.map_err(|message| Error::Problems(vec![message]))?;
        match ranked.iter_mut().find(|(other, _)| *other == by) {
            Some((_, best)) => *best = std::mem::replace(best, Best::new(0)).merge(found),
            None => ranked.push((by, found)),
        }
    }
    match failure {
        _ if !ranked.is_empty() => {}
        _ if !lacking.is_empty() => return Err(Error::Problems(lacking)),
        // The shards are the best by an expression of other families.
        Some(_) if options.by.is_none() && options.top.is_none() => return Ok(Ranking::default()),
        Some(error) => return Err(error),
        None => {}
    }
    notes.extend(lacking.into_iter().map(|message| format!("no curve of {message}")));
    let by = ranked.iter().map(|(by, _)| (*by).clone()).collect();
    let (columns, best) = read_best(gathered, ranked.into_iter().flat_map(|(_, best)| best.into_sorted()).collect())?;
    Ok(Ranking { by, columns, best })
}

fn best_of_file(
    (k, family): (usize, &Family),
    (n, file): (usize, &ShardFile),
    expression: &CompiledExpression,
    top: usize,
) -> Result<Best<Row>, String> {
    let mut columns = ["cell", "trace", "circuit"].map(str::to_owned).to_vec();
    // The column of each slot of the expression.
    let mut slots: Vec<(usize, usize)> = Vec::new();
    for &slot in expression.slots() {
        let column = column_name(family, slot);
        let known = columns.iter().position(|other| other == column);
        slots.push((slot, known.unwrap_or(columns.len())));
        if known.is_none() {
            columns.push(column.to_owned());
        }
    }
    let mut best = Best::new(top);
    // Of joints that are traced on one circuit the first counts for all.
    let is_of_circuits = is_of_circuits(family, expression);
    let (mut last_cell, mut circuits) = (f64::NAN, Vec::new());
    let result = file.read_numbers(&columns, |first, values| {
        for (row, ((cell, trace), circuit)) in values[0].iter().zip(&values[1]).zip(&values[2]).enumerate() {
            // A cell without curves has no trace.
            if trace.is_nan() {
                continue;
            }
            if is_of_circuits {
                if last_cell != *cell {
                    (last_cell, circuits) = (*cell, Vec::new());
                }
                if circuits.contains(circuit) {
                    continue;
                }
                circuits.push(*circuit);
            }
            let load = |slot: usize| {
                let place = slots.iter().find(|(known, _)| *known == slot);
                place.and_then(|(_, column)| values[*column].get(row)).copied().unwrap_or(f64::NAN)
            };
            let place = [k, *cell as usize, *trace as usize, *circuit as usize];
            best.add(expression.evaluate(load), (place, n, first + row));
        }
    });
    result.map(|()| best).map_err(|reason| format!("{}: {reason}", file.path.display()))
}

/// The column for the name at an index of [`Family::scope`], which is that of a number.
fn column_name(family: &Family, slot: usize) -> &str {
    let mut numbers = measure::ALL.iter().filter(|measure| !measure.is_word);
    match slot.checked_sub(family.names.len()) {
        None => &family.names[slot],
        Some(slot) => numbers.nth(slot).map_or("", |measure| measure.name_for(family.template.is_driven_by_length())),
    }
}

/// The rows of the best, with the columns of all their families.
fn read_best(gathered: &[Gathering], best: Vec<Ranked<Row>>) -> Result<(Vec<String>, Vec<BestCurve>), Error> {
    let mut wanted: BTreeMap<(usize, usize), BTreeSet<usize>> = BTreeMap::new();
    for Ranked { place: ([family, ..], file, row), .. } in &best {
        wanted.entry((*family, *file)).or_default().insert(*row);
    }
    let families: BTreeSet<usize> = wanted.keys().map(|(family, _)| *family).collect();
    let columns = all_columns(families.iter().map(|family| &gathered[*family]));
    let wanted: Vec<((usize, usize), BTreeSet<usize>)> = wanted.into_iter().collect();
    let read = |((family, n), rows): &((usize, usize), BTreeSet<usize>)| {
        let file = &gathered[*family].1[*n];
        let rows = file.read_rows(rows).map_err(|reason| format!("{}: {reason}", file.path.display()))?;
        Ok(rows.into_iter().map(|(row, fields)| ((*family, *n, row), fields)).collect::<Vec<_>>())
    };
    let rows: Result<Vec<_>, String> = wanted.par_iter().map(read).collect();
    let rows = rows.map_err(|message| Error::Problems(vec![message]))?;
    let mut rows: BTreeMap<(usize, usize, usize), StringRecord> = rows.into_iter().flatten().collect();
    let curve = |Ranked { key, place: ([family, place @ ..], n, row) }: Ranked<Row>| {
        let texts = rows.remove(&(family, n, row)).unwrap_or_default();
        let (plan, files) = &gathered[family];
        let own = &files[n].record.columns;
        let field = |name: &String| {
            let at = own.iter().position(|column| column == name);
            at.and_then(|at| texts.get(at)).unwrap_or_default()
        };
        let template = &plan.families[0].family.template;
        let parameters = template.parameters.iter().map(|parameter| field(&parameter.name));
        let parameters = parameters.map(|text| text.parse().unwrap_or(f64::NAN)).collect();
        BestCurve { key, family, place, parameters, fields: columns.iter().map(field).collect() }
    };
    let best = best.into_iter().map(curve).collect();
    Ok((columns, best))
}

/// The columns of some families in the order of tables: numbers, the parameters of all, status and reason, measures, family and
/// joint.
fn all_columns<'g>(families: impl Iterator<Item = &'g (Plan, Vec<ShardFile>)>) -> Vec<String> {
    let (mut parameters, mut measures): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    for (plan, files) in families {
        let PlannedFamily { family, .. } = &plan.families[0];
        let count = family.template.parameters.len();
        let columns = &files[0].record.columns;
        let middle = columns.get(3 + count + 2..columns.len().saturating_sub(2)).unwrap_or_default();
        for (names, known) in
            [(columns.get(3..3 + count).unwrap_or_default(), &mut parameters), (middle, &mut measures)]
        {
            for name in names {
                if !known.contains(name) {
                    known.push(name.clone());
                }
            }
        }
    }
    // Each family has its measures in the order of all of them.
    let order = |name: &String| {
        measure::ALL.iter().position(|measure| measure.names().any(|own| own == name)).unwrap_or(usize::MAX)
    };
    measures.sort_by_key(order);
    let fixed = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    [
        fixed(&["cell", "trace", "circuit"]),
        parameters,
        fixed(&["status", "reason"]),
        measures,
        fixed(&["family", "joint"]),
    ]
    .concat()
}
