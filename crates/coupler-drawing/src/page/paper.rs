//! Papers.

/// The size of the paper, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// The width.
    pub width: f64,
    /// The height.
    pub height: f64,
}

impl Paper {
    /// The papers that have a name, all in landscape format.
    pub const NAMED: [(&'static str, Paper); 9] = [
        ("letter", Paper { width: 279.4, height: 215.9 }),
        ("tabloid", Paper { width: 431.8, height: 279.4 }),
        ("a4", Paper { width: 297.0, height: 210.0 }),
        ("a3", Paper { width: 420.0, height: 297.0 }),
        ("a2", Paper { width: 594.0, height: 420.0 }),
        ("a1", Paper { width: 841.0, height: 594.0 }),
        ("a0", Paper { width: 1189.0, height: 841.0 }),
        ("a5", Paper { width: 210.0, height: 148.0 }),
        ("a6", Paper { width: 148.0, height: 105.0 }),
    ];

    /// The paper with its longer side as its height, or as its width.
    pub fn turned(self, is_portrait: bool) -> Paper {
        let Paper { width, height } = self;
        let (short, long) = (width.min(height), width.max(height));
        if is_portrait { Paper { width: short, height: long } } else { Paper { width: long, height: short } }
    }

    /// Larger papers of about the same proportions, by a tenth each, the smallest first; their sides are in steps of 5 mm.
    pub(super) fn larger(self) -> impl Iterator<Item = Paper> {
        const STEP: f64 = 5.0;
        let factors = std::iter::successors(Some(1.1), |factor| Some(1.1 * factor)).take(20);
        factors.map(move |factor| {
            let side = |side: f64| (side * factor / STEP).ceil() * STEP;
            Paper { width: side(self.width), height: side(self.height) }
        })
    }

    /// The least and the greatest side of a page, in millimetres: on a smaller one, text of [`MIN_TEXT_SIZE`](crate::scene::MIN_TEXT_SIZE)
    /// leaves too little to figures.
    pub const SIDE_RANGE: [f64; 2] = [100.0, 2000.0];
}
