use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

use super::{complete, is_sound, is_unfinished, old_and_new, undisturbed};
use crate::folder::{Atlas, files, tree};

/// So many runs are killed.
const KILLS: usize = 30;

/// Numbers from 0 to 1, always the same (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Starts a run, kills it after some time, and tells whether it had not ended before.
fn killed(atlas: &Atlas, after: Duration) -> bool {
    let mut child = atlas.command(&["-q"]).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(after);
    child.kill().unwrap();
    child.wait().unwrap().code().is_none()
}

#[test]
fn runs_that_are_killed_at_any_moment_come_to_the_same() {
    let [mut from, mut to] = old_and_new();
    let begun = Instant::now();
    let mut before = undisturbed(&from);
    // Moments are spread over a run and a bit; how long one takes decides nothing else.
    let whole = begun.elapsed();
    let mut after = undisturbed(&to);
    let atlas = Atlas::new(&from);
    let mut random = Random(1951);
    let (mut kills, mut leftovers, mut tries) = (0, 0, 0);
    // The first runs of all, and then changes from one manifest to the other.
    complete_after(&atlas, 3, &mut || killed(&atlas, whole.mul_f64(random.next())));
    assert!(tree(&atlas.out()) == before);
    while kills < KILLS && tries < 10 * KILLS {
        atlas.edit(&to);
        for _ in 0..4 {
            tries += 1;
            kills += usize::from(killed(&atlas, whole.mul_f64(1.1 * random.next())));
            is_sound(&atlas.out(), &before, &after);
            leftovers += files(&atlas.out()).iter().filter(|name| is_unfinished(name)).count();
        }
        complete(&atlas);
        assert!(tree(&atlas.out()) == after);
        (from, to) = (to, from);
        (before, after) = (after, before);
    }
    assert!(kills >= KILLS && leftovers > 0, "{kills} runs were killed, and left {leftovers} files unfinished");
}

/// A run that ends well after some that are killed.
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

/// Of a family that was never recorded, and is no longer in the manifest, nobody knows but by what is left.
#[test]
fn what_is_unfinished_goes_wherever_it_is() {
    let atlas = Atlas::new(&old_and_new()[0]);
    complete(&atlas);
    let expected = tree(&atlas.out());
    fs::create_dir(atlas.out().join("gone")).unwrap();
    let left = ["gone/.coupler-atlas-a1B2c3.tmp", "evans/.coupler-atlas-zzzzzz.tmp", ".coupler-atlas-000000.tmp"];
    let mine = ["gone/.coupler-atlas-notes.txt", "gone/notes.tmp", "coupler-atlas-1.tmp"];
    left.iter().chain(&mine).for_each(|name| fs::write(atlas.out().join(name), "half a pa").unwrap());
    complete(&atlas);
    let mut found = tree(&atlas.out());
    mine.iter().for_each(|name| assert!(found.remove(*name).is_some(), "{name}"));
    assert!(found == expected);
}
