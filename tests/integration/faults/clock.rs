use std::fs::{self, File};
use std::time::{Duration, SystemTime};

use super::{complete, old_and_new, undisturbed};
use crate::support::folder::{Atlas, files, times, tree};

/// Sets the time of every file of an atlas, and of its manifest.
fn set_times(atlas: &Atlas, time: SystemTime) {
    for name in files(atlas.0.path()) {
        File::options().write(true).open(atlas.0.path().join(name)).unwrap().set_modified(time).unwrap();
    }
}

/// After the clock is set, files may have times in the past or the future; what is drawn depends on their contents.
#[test]
#[ignore = "thorough"]
fn the_times_of_files_do_not_matter() {
    let [old, new] = old_and_new();
    let [before, after] = [&old, &new].map(|manifest| undisturbed(manifest));
    let day = Duration::from_secs(24 * 3600);
    for time in [SystemTime::UNIX_EPOCH + day, SystemTime::now() - 9 * day, SystemTime::now() + 9000 * day] {
        let atlas = Atlas::new(&old);
        complete(&atlas);
        set_times(&atlas, time);
        let dated = times(&atlas.out());
        let (code, out, err) = atlas.run(&[]);
        assert!(code == 0 && out.matches("(unchanged)").count() == 3, "{out}{err}");
        assert_eq!(times(&atlas.out()), dated, "nothing is written");
        assert!(tree(&atlas.out()) == before);
        // A change in a manifest that is older, or a file of the same length and time.
        atlas.edit(&new);
        set_times(&atlas, time);
        complete(&atlas);
        assert!(tree(&atlas.out()) == after);
        let page = atlas.out().join("evans/evans-007.svg");
        let edited = fs::read_to_string(&page).unwrap().replace("Evans", "Evens");
        fs::write(&page, edited).unwrap();
        set_times(&atlas, time);
        complete(&atlas);
        assert!(tree(&atlas.out()) == after);
    }
}
