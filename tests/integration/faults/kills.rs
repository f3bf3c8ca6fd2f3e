use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

use super::{check_files, complete, is_unfinished, old_and_new, undisturbed};
use crate::support::folder::{Atlas, files, tree};

/// The number of runs that are killed.
const KILLS: usize = 30;

/// A reproducible sequence of random numbers from 0 to 1 (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Starts a run and kills it after this time; whether it was still running.
fn kill_after(atlas: &Atlas, time: Duration) -> bool {
    let mut child = atlas.command(&["-q"]).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(time);
    child.kill().unwrap();
    child.wait().unwrap().code().is_none()
}

#[test]
#[ignore = "thorough"]
fn runs_killed_at_any_moment_lead_to_the_same_files() {
    let [mut from, mut to] = old_and_new();
    let start = Instant::now();
    let mut before = undisturbed(&from);
    // The moments of the kills are spread over this duration and a little more.
    let duration = start.elapsed();
    let mut after = undisturbed(&to);
    let atlas = Atlas::new(&from);
    let mut random = Random(1951);
    let (mut kills, mut leftovers, mut tries) = (0, 0, 0);
    // First runs, and then changes from one manifest to the other.
    complete_after(&atlas, 3, &mut || kill_after(&atlas, duration.mul_f64(random.next())));
    assert!(tree(&atlas.out()) == before);
    while kills < KILLS && tries < 10 * KILLS {
        atlas.edit(&to);
        for _ in 0..4 {
            tries += 1;
            kills += usize::from(kill_after(&atlas, duration.mul_f64(1.1 * random.next())));
            check_files(&atlas.out(), &before, &after);
            leftovers += files(&atlas.out()).iter().filter(|name| is_unfinished(name)).count();
        }
        complete(&atlas);
        assert!(tree(&atlas.out()) == after);
        (from, to) = (to, from);
        (before, after) = (after, before);
    }
    assert!(kills >= KILLS && leftovers > 0, "{kills} runs were killed, and left {leftovers} files unfinished");
}

/// Kills this many first runs, each in an empty folder, and completes the atlas of the last.
fn complete_after(atlas: &Atlas, kills: usize, kill: &mut dyn FnMut() -> bool) {
    let mut killed = 0;
    for _ in 0..10 * kills {
        killed += usize::from(kill());
        if killed == kills {
            break;
        }
        let _ = fs::remove_dir_all(atlas.out());
    }
    complete(atlas);
}

/// The folder `gone` is neither in the record nor in the manifest.
#[test]
fn unfinished_files_are_removed_from_every_folder() {
    let atlas = Atlas::new(&old_and_new()[0]);
    complete(&atlas);
    let expected = tree(&atlas.out());
    fs::create_dir(atlas.out().join("gone")).unwrap();
    let unfinished = ["gone/.coupler-atlas-a1B2c3.tmp", "evans/.coupler-atlas-zzzzzz.tmp", ".coupler-atlas-000000.tmp"];
    let mine = ["gone/.coupler-atlas-notes.txt", "gone/notes.tmp", "coupler-atlas-1.tmp"];
    unfinished.iter().chain(&mine).for_each(|name| fs::write(atlas.out().join(name), "half a pa").unwrap());
    complete(&atlas);
    let mut found = tree(&atlas.out());
    mine.iter().for_each(|name| assert!(found.remove(*name).is_some(), "{name}"));
    assert!(found == expected);
}
