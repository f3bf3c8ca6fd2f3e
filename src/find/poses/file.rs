//! The poses in a file.

use coupler_find::{BodyPose, PoseSet};

use coupler_paths::{ReadOptions, Reading, parse_outline};

/// Poses of a file.
#[derive(Clone, Debug)]
pub struct PoseReading {
    /// The poses.
    pub poses: PoseSet,
    /// What of the file was taken, as a clause.
    pub taken: String,
}

/// Reads poses: points, each with the angle of the body, as the angles of a timed path are read. `outline` chooses one of several tables.
///
/// # Errors
/// Every problem, with its line where it has one.
pub fn read_poses(bytes: &[u8], outline: Option<&str>) -> Result<PoseReading, Vec<String>> {
    const ANGLE: &str =
        "each pose needs the angle of the body: write it as a third column named angle_deg or angle_rad";
    let options = ReadOptions { is_timed: true, outline, angles_of: "body", ..ReadOptions::default() };
    let outline = parse_outline(bytes, &options)?;
    let Reading { taken, .. } = outline.reading;
    let Some(angles_deg) = outline.angles_deg else {
        let missing = if outline.points.is_empty() { "it has no pose: give 2 or more" } else { ANGLE };
        return Err(vec![missing.to_owned()]);
    };
    let poses = outline.points.iter().zip(angles_deg).map(|(point, angle_deg)| BodyPose { point: *point, angle_deg });
    let poses: Vec<BodyPose> = poses.collect();
    let poses = PoseSet::new(&poses).map_err(|errors| errors.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    Ok(PoseReading { poses, taken })
}
