//! The automaton with 64 cells in a word, equal to the form that reads like the rules bit for bit.
//!
//! A plane is a run of rows, each of whole words, between two rows of 0 before and behind, so that a neighbour is a word
//! at a fixed distance. act and ext are read around and written elsewhere; hum and cld change in place.

use multiversion::multiversion;
use rayon::prelude::*;

use super::cells::check;
use super::kernel::{ALL, Around, CLOUD, FREE, LANES, Masks, Plane, Room, advance};
use super::{Activation, Brackets, Cells, Field, Injection, Lock, Outside, Rules};

/// Cells in a word.
const BITS: usize = 64;

/// The state of all cells.
#[derive(Clone)]
pub struct Packed {
    counts: [usize; 3],
    rules: Rules,
    room: Room,
    hum: Vec<u64>,
    act: Vec<u64>,
    cld: Vec<u64>,
    ext: Vec<u64>,
    /// act and ext of the step before, to be written over.
    spare: [Vec<u64>; 2],
    /// How long cells are locked, in binary: plane by plane, within it digit by digit, the lowest first.
    locked: Vec<u64>,
    digits: usize,
    steps: u64,
}

impl Packed {
    /// A lattice of so many cells along x, y and z, all 0.
    ///
    /// # Errors
    ///
    /// No cells, or too many.
    pub fn new(counts: [usize; 3], rules: Rules) -> Result<Self, Outside> {
        check(counts)?;
        let row = counts[0].div_ceil(BITS);
        let room = Room { row, words: (row * counts[1]).next_multiple_of(LANES) };
        let none = vec![0; room.stride() * counts[2]];
        let digits = (u8::BITS - rules.lifetime.leading_zeros()) as usize;
        Ok(Self {
            counts,
            rules,
            room,
            hum: none.clone(),
            act: none.clone(),
            cld: none.clone(),
            ext: none.clone(),
            spare: [none.clone(), none],
            locked: vec![0; digits * room.words * counts[2]],
            digits,
            steps: 0,
        })
    }

    /// Cells along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// Steps that have been made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Makes a step: Eq. (1) to (5) and the lifetime of §2.2.
    pub fn step(&mut self) {
        let (room, digits, lifetime) = (self.room, self.digits, self.rules.lifetime);
        let (stride, held) = (room.stride(), digits * room.words);
        let before = Before {
            room,
            masks: self.masks(),
            act: &self.act,
            ext: &self.ext,
            outside: vec![0; stride],
            layers: self.counts[2],
        };
        let form = Form::of(&self.rules);
        let [next_act, next_ext] = &mut self.spare;
        let variables = (self.hum.par_chunks_mut(stride).zip(self.cld.par_chunks_mut(stride)))
            .zip(next_act.par_chunks_mut(stride).zip(next_ext.par_chunks_mut(stride)))
            .enumerate();
        let one = |k: usize, mut plane: Plane, held: &mut [u64]| {
            // Locked are cells any digit of which is set.
            let mut locked = vec![0; if digits > 0 { room.words } else { 0 }];
            for digit in held.chunks(room.words) {
                locked.iter_mut().zip(digit).for_each(|(locked, word)| *locked |= word);
            }
            let kept = locked.clone();
            plane.locked = locked;
            step_plane(form, &before, k, &mut plane);
            count_down(held, &kept, &plane.locked, lifetime);
        };
        // A few planes at a time: less is not worth a task.
        if digits == 0 {
            variables.with_min_len(4).for_each(|(k, ((hum, cld), (act, ext)))| {
                one(k, Plane { hum, cld, act, ext, locked: Vec::new() }, &mut []);
            });
        } else {
            let planes = variables.zip(self.locked.par_chunks_mut(held)).with_min_len(4);
            planes.for_each(|((k, ((hum, cld), (act, ext))), held)| {
                one(k, Plane { hum, cld, act, ext, locked: Vec::new() }, held);
            });
        }
        std::mem::swap(&mut self.act, next_act);
        std::mem::swap(&mut self.ext, next_ext);
        self.steps += 1;
    }

    fn masks(&self) -> Masks {
        let (row, words) = (self.room.row, self.room.words);
        let real = row * self.counts[1];
        let rest = self.counts[0] % BITS;
        let last = if rest == 0 { u64::MAX } else { (1 << rest) - 1 };
        let all =
            |keep: &dyn Fn(usize) -> u64| (0..words).map(|k| if k < real { keep(k) } else { 0 }).collect();
        let unless = |at: bool| if at { 0 } else { u64::MAX };
        Masks {
            valid: all(&|k| if k % row + 1 == row { last } else { u64::MAX }),
            east: all(&|k| unless(k % row + 1 == row)),
            west: all(&|k| unless(k % row == 0)),
        }
    }

    /// Sets cells to 1 as §2.3 has it, at the time that the state is at.
    pub fn inject(&mut self, injection: &Injection) {
        let (counts, room) = (self.counts, self.room);
        // Where all variables are locked nothing comes either.
        let digits = if self.rules.lock == Lock::All { self.digits } else { 0 };
        let locked = &self.locked;
        let chances = injection.chances(counts, self.steps);
        for field in Field::ALL {
            let words = match field {
                Field::Hum => &mut self.hum,
                Field::Act => &mut self.act,
                Field::Ext => &mut self.ext,
            };
            let moment = injection.moment(field, self.steps);
            words.par_chunks_mut(room.stride()).enumerate().with_min_len(4).for_each(|(k, plane)| {
                let held = &locked[k * digits * room.words..][..digits * room.words];
                chances.sample(&moment, field, k, &mut |i, j| {
                    let (word, bit) = (j * room.row + i / BITS, 1 << (i % BITS));
                    if held.chunks(room.words).all(|digit| digit[word] & bit == 0) {
                        plane[room.margin() + word] |= bit;
                    }
                });
            });
        }
    }

    /// Sets a variable of every cell, x fastest, then y, then z.
    ///
    /// # Errors
    ///
    /// Not one value for each cell, or one that is neither 0 nor 1.
    pub fn set(&mut self, field: Field, values: &[u8]) -> Result<(), Outside> {
        let mut cells = Cells::new(self.counts)?;
        cells.set(field, values)?;
        match field {
            Field::Hum => self.hum = self.pack(values),
            Field::Act => self.act = self.pack(values),
            Field::Ext => self.ext = self.pack(values),
        }
        Ok(())
    }

    fn pack(&self, values: &[u8]) -> Vec<u64> {
        let mut words = vec![0; self.room.stride() * self.counts[2]];
        let [nx, ny, _] = self.counts;
        for (row, values) in values.chunks(nx).enumerate() {
            let from = self.row(row % ny, row / ny);
            for (i, value) in values.iter().enumerate() {
                words[from + i / BITS] |= u64::from(*value) << (i % BITS);
            }
        }
        words
    }

    /// The first word of a row.
    fn row(&self, j: usize, k: usize) -> usize {
        k * self.room.stride() + self.room.margin() + j * self.room.row
    }

    fn unpack(&self, words: &[u64]) -> Vec<u8> {
        let [nx, ny, nz] = self.counts;
        let mut values = vec![0; nx * ny * nz];
        values.par_chunks_mut(nx).enumerate().with_min_len(64).for_each(|(row, values)| {
            let from = self.row(row % ny, row / ny);
            for (i, value) in values.iter_mut().enumerate() {
                *value = (words[from + i / BITS] >> (i % BITS)) as u8 & 1;
            }
        });
        values
    }

    /// The cloud of every cell, x fastest, then y, then z.
    pub fn cld(&self) -> Vec<u8> {
        self.unpack(&self.cld)
    }

    /// Another variable of every cell.
    pub fn field(&self, field: Field) -> Vec<u8> {
        self.unpack(match field {
            Field::Hum => &self.hum,
            Field::Act => &self.act,
            Field::Ext => &self.ext,
        })
    }

    /// The share of cells with cloud.
    pub fn cover(&self) -> f64 {
        let cloud: u64 = self.cld.par_iter().map(|word| u64::from(word.count_ones())).sum();
        cloud as f64 / self.counts.iter().product::<usize>() as f64
    }
}

/// What a step reads and does not change.
struct Before<'a> {
    room: Room,
    masks: Masks,
    act: &'a [u64],
    ext: &'a [u64],
    /// A plane of 0.
    outside: Vec<u64>,
    layers: usize,
}

impl Before<'_> {
    #[inline(always)]
    fn around<'s>(&'s self, field: &'s [u64], k: usize) -> Around<'s> {
        let stride = self.room.stride();
        let plane = |k: usize| &field[k * stride..(k + 1) * stride];
        let under = |by: usize| if k >= by { plane(k - by) } else { &self.outside[..] };
        let above = if k + 1 < self.layers { plane(k + 1) } else { &self.outside[..] };
        Around::new(self.room, plane(k), [above, under(1), under(2)])
    }
}

/// The rules of a step as the kernel has them.
#[derive(Clone, Copy)]
struct Form {
    negated: bool,
    mended: bool,
    lock: u8,
}

impl Form {
    fn of(rules: &Rules) -> Self {
        let lock = match rules.lock {
            _ if rules.lifetime == 0 => FREE,
            Lock::Cld => CLOUD,
            Lock::All => ALL,
        };
        Self {
            negated: rules.activation == Activation::Negated,
            mended: rules.brackets == Brackets::Mended,
            lock,
        }
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn step_plane(form: Form, before: &Before, k: usize, plane: &mut Plane) {
    let (act, ext) = (before.around(before.act, k), before.around(before.ext, k));
    let (masks, margin) = (&before.masks, before.room.margin());
    match (form.negated, form.mended, form.lock) {
        (false, false, FREE) => advance::<false, false, FREE>(masks, &act, &ext, plane, margin),
        (false, false, CLOUD) => advance::<false, false, CLOUD>(masks, &act, &ext, plane, margin),
        (false, false, _) => advance::<false, false, ALL>(masks, &act, &ext, plane, margin),
        (false, true, FREE) => advance::<false, true, FREE>(masks, &act, &ext, plane, margin),
        (false, true, CLOUD) => advance::<false, true, CLOUD>(masks, &act, &ext, plane, margin),
        (false, true, _) => advance::<false, true, ALL>(masks, &act, &ext, plane, margin),
        (true, false, FREE) => advance::<true, false, FREE>(masks, &act, &ext, plane, margin),
        (true, false, CLOUD) => advance::<true, false, CLOUD>(masks, &act, &ext, plane, margin),
        (true, false, _) => advance::<true, false, ALL>(masks, &act, &ext, plane, margin),
        (true, true, FREE) => advance::<true, true, FREE>(masks, &act, &ext, plane, margin),
        (true, true, CLOUD) => advance::<true, true, CLOUD>(masks, &act, &ext, plane, margin),
        (true, true, _) => advance::<true, true, ALL>(masks, &act, &ext, plane, margin),
    }
}

/// Takes one from the numbers of locked cells, and gives those that have become cloud the whole lifetime.
fn count_down(held: &mut [u64], kept: &[u64], fresh: &[u64], lifetime: u8) {
    let words = kept.len();
    if words == 0 {
        return;
    }
    let mut borrow = kept.to_vec();
    for (digit, word) in held.chunks_mut(words).enumerate() {
        let set = lifetime >> digit & 1 == 1;
        for (k, word) in word.iter_mut().enumerate() {
            let before = *word;
            *word ^= borrow[k];
            borrow[k] &= !before;
            if set {
                *word |= fresh[k];
            }
        }
    }
}

#[cfg(test)]
mod tests;
