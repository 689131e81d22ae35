//! The seven ways of Fig. 6 in which crystals hold on to each other.

use crate::reading::Reading;

use super::super::{Crystal, Habit};

/// What of a crystal touches another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A basal face; columns have none that Fig. 6 would call one.
    Face,
    /// A straight side of a plate, the line from tip to tip of a dendrite, the edge of a column.
    Line,
    /// A tip of an arm, a corner.
    Point,
}

/// A way of Fig. 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Attachment {
    /// Tips of branches have grown past each other.
    Tangle,
    /// Face to face.
    FaceFace,
    /// Face to line.
    FaceLine,
    /// Face to point.
    FacePoint,
    /// Line to line.
    LineLine,
    /// Line to point.
    LinePoint,
    /// Point to point.
    PointPoint,
}

impl Attachment {
    /// All seven, in the order of Fig. 6.
    pub const ALL: [Self; 7] = [
        Self::Tangle,
        Self::FaceFace,
        Self::FaceLine,
        Self::FacePoint,
        Self::LineLine,
        Self::LinePoint,
        Self::PointPoint,
    ];

    /// What touches what; of a tangle the tips.
    pub fn features(self) -> [Feature; 2] {
        match self {
            Self::FaceFace => [Feature::Face, Feature::Face],
            Self::FaceLine => [Feature::Face, Feature::Line],
            Self::FacePoint => [Feature::Face, Feature::Point],
            Self::LineLine => [Feature::Line, Feature::Line],
            Self::LinePoint => [Feature::Line, Feature::Point],
            Self::PointPoint | Self::Tangle => [Feature::Point, Feature::Point],
        }
    }

    /// In kebab-case: `face-to-line`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tangle => "tangle",
            Self::FaceFace => "face-to-face",
            Self::FaceLine => "face-to-line",
            Self::FacePoint => "face-to-point",
            Self::LineLine => "line-to-line",
            Self::LinePoint => "line-to-point",
            Self::PointPoint => "point-to-point",
        }
    }
}

/// The four types of Fig. 1, which Fig. 5 pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Fig. 1 (a).
    Dendrite,
    /// Fig. 1 (b).
    Needle,
    /// Fig. 1 (c), sectored or not.
    Plate,
    /// Fig. 1 (d), hollow or not.
    Column,
}

impl Kind {
    /// What a crystal counts as: the habit that it grew in for longest; a capped column as a plate, for it touches with
    /// its caps.
    pub fn of(crystal: &Crystal) -> Self {
        if crystal.is_capped() {
            return Self::Plate;
        }
        let mut seconds = [0.0; 6];
        for (habit, time) in crystal.habits() {
            seconds[*habit as usize] += time;
        }
        let longest =
            Habit::ALL.into_iter().max_by(|a, b| seconds[*a as usize].total_cmp(&seconds[*b as usize]));
        match longest {
            Some(Habit::Dendrite) => Self::Dendrite,
            Some(Habit::Needle) => Self::Needle,
            Some(Habit::SolidColumn | Habit::HollowColumn) => Self::Column,
            _ => Self::Plate,
        }
    }

    /// Whether it has a face that Fig. 6 would call one.
    pub fn has_face(self) -> bool {
        matches!(self, Self::Dendrite | Self::Plate)
    }
}

/// How often crystals of two kinds hold on to each other in each way; Fig. 5 and 6 have it as widths of lines and as marks
/// that do not survive.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(
    /// By the kinds of both, in the order of [`Kind`], and by the way, in that of [`Attachment::ALL`]. Relative; those that
    /// geometry forbids are not asked for.
    pub [[[f64; 7]; 4]; 4],
);

impl Weights {
    /// The same for all. An assumption for want of the figures, never Magono's.
    pub const UNIFORM: Self = Self([[[1.0; 7]; 4]; 4]);

    /// The weight of a way between two kinds: 0 where geometry forbids it. A face needs a plate or a dendrite, a tangle two
    /// dendrites (§1.2.1).
    pub fn of(&self, a: Kind, b: Kind, way: Attachment) -> f64 {
        let faces = usize::from(a.has_face()) + usize::from(b.has_face());
        let needed = way.features().iter().filter(|feature| **feature == Feature::Face).count();
        let tangles = a == Kind::Dendrite && b == Kind::Dendrite;
        if faces < needed || (way == Attachment::Tangle && !tangles) {
            return 0.0;
        }
        self.0[a as usize][b as usize][way as usize]
    }

    /// The way for a number from 0 to 1. None if all weights are 0.
    pub fn choose(&self, a: Kind, b: Kind, number: f64) -> Option<Attachment> {
        let of = |way: &Attachment| self.of(a, b, *way);
        let mut left = number * Attachment::ALL.iter().map(of).sum::<f64>();
        let mut chosen = None;
        for way in Attachment::ALL.into_iter().filter(|way| of(way) > 0.0) {
            chosen = Some(way);
            left -= of(&way);
            if left < 0.0 {
                break;
            }
        }
        chosen
    }
}

/// How many crystals make a flake of many (§1.2.1: "the small case repeated").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assembly {
    /// One crystal after the other comes to the flake.
    OneByOne,
    /// Flakes of like number come together.
    FlakeToFlake,
}

impl Reading for Assembly {
    const QUANTITY: &'static str = "assembly";
    const ALL: &'static [Self] = &[Self::OneByOne, Self::FlakeToFlake];

    fn name(self) -> &'static str {
        match self {
            Self::OneByOne => "one-by-one",
            Self::FlakeToFlake => "flake-to-flake",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which way is possible between which: 7 for two dendrites, 6 if one is a plate, 5 with one column, 3 between two.
    #[test]
    fn geometry_forbids_faces_of_columns_and_tangles_of_plates() {
        let possible = |a, b| {
            let weights = Weights::UNIFORM;
            Attachment::ALL.into_iter().filter(|way| weights.of(a, b, *way) > 0.0).count()
        };
        assert_eq!(possible(Kind::Dendrite, Kind::Dendrite), 7);
        assert_eq!(possible(Kind::Dendrite, Kind::Plate), 6);
        assert_eq!(possible(Kind::Plate, Kind::Column), 5);
        assert_eq!(possible(Kind::Needle, Kind::Dendrite), 5);
        assert_eq!(possible(Kind::Needle, Kind::Column), 3);
    }

    #[test]
    fn ways_are_chosen_by_their_weights() {
        let mut weights = Weights::UNIFORM;
        weights.0[0][0] = [0.0, 0.0, 3.0, 0.0, 1.0, 0.0, 0.0];
        let choose = |number| weights.choose(Kind::Dendrite, Kind::Dendrite, number);
        assert_eq!(choose(0.7), Some(Attachment::FaceLine));
        assert_eq!(choose(0.8), Some(Attachment::LineLine));
        weights.0[0][0] = [0.0; 7];
        assert_eq!(weights.choose(Kind::Dendrite, Kind::Dendrite, 0.5), None);
    }
}
