//! What the clouds look like: a still of the last step, and a film of all.

use std::collections::VecDeque;

use snowglobe::automaton_cloud::{Metaballs, Packed, Smoothing};
use snowglobe::image::{Exposure, Picture, ToneCurve, encode, encode_animation};
use snowglobe::lab::{Error, Result};
use snowglobe::volume::{Camera, Density, render};

use crate::dobashi::sky::{many, photograph, unseen};

/// Weights of the steps before and after a frame: so that the film does not boil.
const WEIGHTS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
const FRAMES_PER_SECOND: u16 = 8;
/// From above and in front, a little from the side.
const VIEW: [f64; 3] = [0.32, 0.9, -0.3];
const UP: [f64; 3] = [0.0, 0.0, 1.0];
const STILL: [usize; 2] = [640, 360];
const FILM: [usize; 2] = [320, 180];

/// How clouds are shown.
#[derive(Clone, Copy)]
pub struct Look {
    pub balls: Metaballs,
    /// Width of a cell, m.
    pub voxel: f64,
    /// 1/m deep in cloud.
    pub extinction: f64,
}

impl Look {
    /// The clouds of these central densities, lit by sun, sky and ground.
    fn picture(&self, central: &[f32], size: [usize; 2], octaves: usize) -> Result<Picture> {
        let whole = self.balls.whole() as f32;
        let rho = self.balls.density(central).into_iter().map(|rho| rho / whole).collect();
        let density = Density::new(self.balls.counts, self.voxel, rho).map_err(unseen)?;
        let camera = Camera::orthographic(&density, VIEW, UP, size).map_err(unseen)?;
        let seen = render(&density, self.extinction, &camera, &many(octaves), 1).map_err(unseen)?;
        Ok(photograph(&seen)?.develop(Exposure { stops: 0.0 }, ToneCurve::Filmic))
    }

    /// `cloud.png`.
    pub fn still(&self, clouds: &Packed) -> Result<Vec<u8>> {
        Ok(encode(&self.picture(&self.balls.central(&clouds.cld()), STILL, 6)?))
    }
}

/// `animation.png`: frames at steps as far apart as may be, each smoothed over five steps.
pub struct Film {
    look: Look,
    /// The steps that are shown, rising, and how many of them are.
    shown: VecDeque<u64>,
    /// The central densities of the last steps.
    recent: VecDeque<Vec<f32>>,
    steps: u64,
    frames: Vec<Picture>,
}

impl Film {
    /// Of all steps from 0 on, in so many frames or as many as there are steps.
    pub fn new(look: Look, steps: u64, frames: u64) -> Self {
        let frames = frames.min(steps + 1);
        let shown = (0..frames).map(|k| if frames > 1 { k * steps / (frames - 1) } else { steps }).collect();
        Self { look, shown, recent: VecDeque::new(), steps, frames: Vec::new() }
    }

    /// After step `t`.
    pub fn see(&mut self, t: u64, clouds: &Packed) -> Result<()> {
        let reach = WEIGHTS.len() as u64 / 2;
        // Only what a frame needs is worked out.
        let needed = self.shown.front().is_some_and(|next| t + reach >= *next);
        if !needed {
            return Ok(());
        }
        self.recent.push_back(self.look.balls.central(&clouds.cld()));
        if self.recent.len() > WEIGHTS.len() {
            self.recent.pop_front();
        }
        while self.shown.front().is_some_and(|next| (*next + reach).min(self.steps) <= t) {
            let Some(next) = self.shown.pop_front() else { break };
            self.frame(t, next)?;
        }
        Ok(())
    }

    /// The frame of a step, of which `t` is the last that is known; before the first and after the last all stays.
    fn frame(&mut self, t: u64, at: u64) -> Result<()> {
        let first = t + 1 - self.recent.len() as u64;
        let reach = WEIGHTS.len() as u64 / 2;
        let around: Vec<&[f32]> = (0..WEIGHTS.len() as u64)
            .map(|k| (at + k).saturating_sub(reach).clamp(first, t))
            .map(|step| &self.recent[(step - first) as usize][..])
            .collect();
        let central = Metaballs::over_time(&Smoothing::SpaceTime(WEIGHTS.to_vec()), &around);
        self.frames.push(self.look.picture(&central, FILM, 4)?);
        Ok(())
    }

    /// The film's file; none of no frames.
    pub fn file(self) -> Result<Option<Vec<u8>>> {
        if self.frames.is_empty() {
            return Ok(None);
        }
        let file = encode_animation(&self.frames, FRAMES_PER_SECOND);
        file.map(Some).map_err(|cause| Error::broken("cannot make an animation").because(cause))
    }
}
