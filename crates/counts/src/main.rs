//! Counts the instructions of what this program spends its time on, by callgrind of valgrind, on one thread: `.ci/counts`.
//!
//! Times are noisy, counts are not: of the same program, with the same compiler, they differ by less than a thousandth from run to run and from
//! machine to machine. `counts.csv` has those that are recorded, in all and for each function that has a hundredth of them. One that is more than 3 %
//! above fails, and says in which functions; `.ci/counts --bless` records what is counted now. With another compiler they are only printed.

mod callgrind;
mod composed;
mod record;
mod work;

use std::process::ExitCode;

use record::Record;

/// How much a count may be above the recorded one.
const ALLOWED: f64 = 1.03;

/// The functions that are named of a count that is above.
const NAMED: usize = 8;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["--run", name] => {
            run(name);
            ExitCode::SUCCESS
        }
        [] => compare(&[]),
        ["--bless"] => bless(),
        [..] => match arguments.iter().find(|name| work::ALL.iter().all(|(other, _)| other != *name)) {
            Some(unknown) => {
                let names = work::ALL.map(|(name, _)| name).join("\n    ");
                eprintln!("counts: there is no `{unknown}`; there are\n    {names}");
                ExitCode::from(2)
            }
            None => compare(&arguments),
        },
    }
}

/// Does the work of a benchmark; that of the function `counted` is counted.
fn run(name: &str) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    one.build_global().expect("one thread");
    let (_, prepare) = work::ALL.into_iter().find(|(other, _)| *other == name).expect("a benchmark of this name");
    let mut work = prepare();
    counted(&mut work);
}

/// The only function whose instructions are counted, with those that it calls.
#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    work();
}

/// Compares the counts of some benchmarks with those that are recorded; of all, if none is named.
fn compare(names: &[&str]) -> ExitCode {
    let recorded = Record::read();
    let compiler = record::compiler();
    let is_same = recorded.compiler == compiler;
    if !is_same {
        println!("counts: recorded with {}, and this is {compiler}: they are not compared", recorded.compiler);
    }
    let mut is_above = false;
    for (name, _) in work::ALL.into_iter().filter(|(name, _)| names.is_empty() || names.contains(name)) {
        let counts = callgrind::count(name);
        let Some(before) = recorded.benchmarks.get(name) else {
            println!("{name}: {} instructions, of which none are recorded: .ci/counts --bless", counts.all);
            is_above |= is_same;
            continue;
        };
        let ratio = counts.all as f64 / before.all as f64;
        println!("{name}: {} instructions, {:+.2} %", counts.all, 100.0 * (ratio - 1.0));
        if ratio > ALLOWED {
            is_above |= is_same;
            for (function, difference) in
                counts.rises(before, record::least_recorded(before.all)).into_iter().take(NAMED)
            {
                println!("    {:+.2} %  {function}", 100.0 * difference as f64 / before.all as f64);
            }
        }
    }
    if is_above {
        eprintln!("counts: more than 3 % above what is recorded; if that is meant, .ci/counts --bless");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

/// Records the counts of all benchmarks.
fn bless() -> ExitCode {
    let counted = |(name, _): work::Benchmark| {
        let counts = callgrind::count(name);
        println!("{name}: {} instructions", counts.all);
        (name.to_owned(), counts)
    };
    Record { compiler: record::compiler(), benchmarks: work::ALL.into_iter().map(counted).collect() }.write();
    ExitCode::SUCCESS
}
