//! The assumptions of a crystal: of all this the paper prints no number.

use super::{HabitLimits, Manner, SnowError, within};

/// How branches grow, of a habit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// Speed of a branch as a share of that of the one it began on: condition 4.
    pub slowing: f64,
    /// p1 of a branch as a share of p1 of the one it began on.
    pub sparing: f64,
    /// Speed at which straight sides of branches move outwards, as a share of the speed of arms.
    pub widening: f64,
    /// How slender branches stay: 1 if their sides slow down as they widen, 0 if they do not.
    pub slender: f64,
    /// Branches stop where r > sector q in their twelfth: 1 is the edge of the sector of 60 degrees.
    pub sector: f64,
}

/// What must be assumed to grow a crystal. [`Parameters::ASSUMED`] says why each is what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// b_min, the side of an element, m: the spacing of cells and of layers.
    pub element: f64,
    /// Radius of the sphere of ice that begins to grow, m.
    pub seed_radius: f64,
    /// The step of time, s; it is cut where a crystal would grow by more than half a cell.
    pub step: f64,
    /// Pressure of the air, Pa.
    pub pressure: f64,
    /// By how much a crystal that falls gathers more vapour than one at rest.
    pub ventilation: f64,
    /// How branches grow up to the share of ice `loose`.
    pub dendrite: Form,
    /// How they grow from the share of ice `broad` on; between the two it changes smoothly.
    pub plate: Form,
    /// Share of ice, of the volume of what is deposited, up to which dendrites grow.
    pub loose: f64,
    /// Share of ice from which plates grow, sectored or not.
    pub broad: f64,
    /// Share of ice from which plates grow without gaps between sectors.
    pub closed: f64,
    /// Share of a loose dendrite's layers that is ice over a cell of the first layer: since upper layers are smaller, the
    /// first fills more of its hexagon than the crystal does.
    pub relief: f64,
    /// How far to its sides a tip feels other branches, m.
    pub spacing: f64,
    /// Half the width of a slender branch from which its sides move at less than half of their speed, m.
    pub width: f64,
    /// The highest order of branch that is grown; arms have order 0.
    pub most_order: usize,
    /// Speed of the arms of upper layers as a share of that of the first.
    pub ridge: f64,
    /// p1 on the second layer and above where the layer below has branched: condition 6.
    pub above_branch: f64,
    /// By what p1 is multiplied there where it has not.
    pub above_none: f64,
    /// Chance that a cell amid ice begins the next layer while c grows by a layer, in a plate: condition 5.
    pub births: f64,
    /// The power of the share of ice around with which that chance falls.
    pub births_power: i32,
    /// Where one habit becomes another.
    pub habits: HabitLimits,
}

impl Parameters {
    /// | | | why |
    /// |---|---|---|
    /// | element | 10 um | half the width of the finest side branches |
    /// | seed_radius | 10 um | a frozen drop of a cloud |
    /// | step | 1 s | at the fastest a dendrite grows by a third of a cell in it |
    /// | pressure | 1000 hPa | near the ground |
    /// | ventilation | 1 | at rest: Chen & Lamb's tables were fitted with their own factor, which is 1 for small ones |
    /// | dendrite.slowing | 0.7 | arms are as wide as a fern in photographs, widest at 0.7/1.7 = 2/5 of their length |
    /// | dendrite.sparing | 0.3 | in photographs side branches are many, and their own branches few |
    /// | dendrite.widening | 0.06 | branches are twice as wide as an element when arms have grown by 0.2 mm |
    /// | dendrite.slender | 1 | branches of dendrites are thin and of even width |
    /// | dendrite.sector | 0.85 | side branches stop before those of the next arm |
    /// | plate.slowing, sparing, slender | 1, 1, 0 | straight sides of a hexagon move as fast as its corners |
    /// | plate.widening | 0.1 | sectors close up from the middle |
    /// | plate.sector | 1 | the whole sector; less where the share of ice asks for it |
    /// | loose, broad | 0.2, 0.3 | around the limit of dendrites |
    /// | closed | 0.8 | plates at -2 C and at little supersaturation have no gaps |
    /// | relief | 0.4 | so the first layer of a dendrite at water saturation fills a third of its hexagon |
    /// | spacing | 40 um | side branches stand 50 um apart and more |
    /// | width | 15 um | side branches in photographs are some 30 um wide |
    /// | most_order | 4 | what is finer is below the element |
    /// | ridge | 0.85 | ridges end before tips do |
    /// | above_branch, above_none | 0.8, 0.1 | condition 6 asks that the first is larger |
    /// | births, births_power | 2, 4 | faces of plates come out flat; condition 5 asks that it rises with density |
    pub const ASSUMED: Self = Self {
        element: 10e-6,
        seed_radius: 10e-6,
        step: 1.0,
        pressure: 1e5,
        ventilation: 1.0,
        dendrite: Form { slowing: 0.7, sparing: 0.3, widening: 0.06, slender: 1.0, sector: 0.85 },
        plate: Form { slowing: 1.0, sparing: 1.0, widening: 0.1, slender: 0.0, sector: 1.0 },
        loose: 0.2,
        broad: 0.3,
        closed: 0.8,
        relief: 0.4,
        spacing: 40e-6,
        width: 15e-6,
        most_order: 4,
        ridge: 0.85,
        above_branch: 0.8,
        above_none: 0.1,
        births: 2.0,
        births_power: 4,
        habits: HabitLimits::ASSUMED,
    };

    /// Whether the numbers can be grown with.
    ///
    /// # Errors
    ///
    /// The first, in the order of the fields, that cannot.
    pub fn check(&self) -> Result<(), SnowError> {
        for (name, value, least, most) in [
            ("the side of an element, m,", self.element, 1e-7, 1e-3),
            ("the radius of the seed, m,", self.seed_radius, 1e-7, 1e-3),
            ("the step of time, s,", self.step, 1e-3, 60.0),
            ("the pressure, Pa,", self.pressure, 1e4, 2e5),
            ("the ventilation", self.ventilation, 0.0, 100.0),
            ("the share of ice of dendrites", self.loose, 0.0, 1.0),
            ("the share of ice of plates", self.broad, self.loose, 1.0),
            ("the share of ice of closed plates", self.closed, 1e-3, 1.0),
            ("the relief", self.relief, 1e-3, 1.0),
            ("the spacing, m,", self.spacing, 0.0, 1e-2),
            ("half the width, m,", self.width, 1e-9, 1e-2),
            ("the highest order", self.most_order as f64, 0.0, 16.0),
            ("the speed of ridges", self.ridge, 0.0, 1.0),
            ("p1 above a branch", self.above_branch, 0.0, 1.0),
            ("the factor of p1 above none", self.above_none, 0.0, 1.0),
            ("the chance to begin a layer", self.births, 0.0, 100.0),
            ("the power of that chance", f64::from(self.births_power), 0.0, 32.0),
        ] {
            within(name, value, least, most)?;
        }
        for form in [&self.dendrite, &self.plate] {
            within("the slowing of branches", form.slowing, 0.0, 1.0)?;
            within("the sparing of branches", form.sparing, 0.0, 1.0)?;
            within("the widening of branches", form.widening, 0.0, 0.99)?;
            within("the slenderness of branches", form.slender, 0.0, 1.0)?;
            within("the part of the sector", form.sector, 0.0, 1.0)?;
        }
        let HabitLimits { dendrite, sectored, hollow, needle } = self.habits;
        for (name, value, least, most) in [
            ("the limit of dendrites", dendrite, 0.0, 1.0),
            ("the limit of sectored plates", sectored, 0.0, 1.0),
            ("the limit of hollow columns", hollow, 0.0, 1.0),
            ("the limit of needles", needle, 0.0, 10.0),
        ] {
            within(name, value, least, most)?;
        }
        Ok(())
    }

    pub(super) fn manner(&self) -> Manner {
        Manner {
            spacing: libm::round(self.spacing / self.element).min(64.0) as i32,
            width: self.width / self.element,
            most_order: self.most_order,
            ridge: self.ridge,
            above_branch: self.above_branch,
            above_none: self.above_none,
            births: self.births,
            births_power: self.births_power,
        }
    }

    /// The share of its hexagon that the first layer is to fill, for the share of ice in what is deposited.
    pub fn layer_fill(&self, fill: f64) -> f64 {
        let fill = (fill / self.closed).min(1.0);
        fill / (self.relief + (1.0 - self.relief) * fill)
    }

    /// 0 of dendrites, 1 of plates.
    pub(super) fn part(&self, fill: f64) -> f64 {
        if fill >= self.broad {
            return 1.0;
        }
        let part = ((fill - self.loose) / (self.broad - self.loose)).max(0.0);
        part * part * (3.0 - 2.0 * part)
    }

    /// How branches grow, for the share of ice in what is deposited, before the sector of plates is fitted to it.
    pub(super) fn form(&self, fill: f64) -> Form {
        let part = self.part(fill);
        let between = |dendrite: f64, plate: f64| dendrite + (plate - dendrite) * part;
        Form {
            slowing: between(self.dendrite.slowing, self.plate.slowing),
            sparing: between(self.dendrite.sparing, self.plate.sparing),
            widening: between(self.dendrite.widening, self.plate.widening),
            slender: between(self.dendrite.slender, self.plate.slender),
            sector: between(self.dendrite.sector, self.plate.sector),
        }
    }
}
