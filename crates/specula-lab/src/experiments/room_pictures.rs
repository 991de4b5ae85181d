//! Rooms rendered by cap, bounded and exact sampler with the same number of samples: pictures with
//! insets, rows of a table, for the figures of Tokuyoshi and Eto 2024.

use specula_render::picture::Picture;
use specula_render::{RenderOptions, Strategy};
use specula_scene::Scene;

use super::sampler_trials::{
    CAP_BOUNDED_EXACT, Plan, Prepared, Reference, TURQUIN, Trial, deviations_above, mean, trials,
};
use crate::output::{Inset, PictureComparison, Shot, Table};
use crate::scenes::orbs::{self, Tessellation};
use crate::scenes::{bathroom, interior, kitchen};
use crate::{Errors, Lab, Result, errors};

/// A room and its insets.
pub(super) struct Room {
    pub(super) name: &'static str,
    pub(super) scene: Scene,
    /// Column, row, columns and rows of a picture 512 pixels wide.
    insets: [[u32; 4]; 3],
    exposure_stops: f32,
}

/// The living room.
pub(super) fn fireplace_room() -> Room {
    Room {
        name: "fireplace room",
        scene: interior::interior(),
        insets: [[264, 36, 64, 48], [70, 70, 64, 48], [330, 196, 64, 48]],
        exposure_stops: 0.0,
    }
}

/// The kitchen.
pub(super) fn kitchen_room() -> Room {
    Room {
        name: "kitchen",
        scene: kitchen::kitchen(),
        insets: [[244, 70, 64, 48], [92, 142, 64, 48], [430, 110, 64, 48]],
        exposure_stops: 0.0,
    }
}

/// The bathroom.
pub(super) fn bathroom_room() -> Room {
    Room {
        name: "bathroom",
        scene: bathroom::bathroom(),
        insets: [[226, 40, 64, 48], [346, 156, 64, 48], [330, 226, 64, 48]],
        exposure_stops: 0.5,
    }
}

/// Three orbs, 3:1: in the place of the paper's orb, where there are no rooms.
pub(super) fn rough_orbs() -> Scene {
    let alphas = [(0.4, 0.4), (0.7, 0.7), (1.0, 1.0)];
    orbs::row(&alphas, Tessellation::FINE, 96)
}

/// Work for a room.
pub(super) struct Budget {
    /// Columns of the picture, 16:9.
    pub(super) width: u32,
    /// Per pixel and render.
    pub(super) samples: u32,
    /// Renders of each sampler, whose mean is the picture.
    pub(super) rounds: u32,
    /// Per pixel.
    pub(super) reference_samples: u32,
}

impl Budget {
    /// Samples of a pixel of the picture.
    fn all_samples(&self) -> u32 {
        self.samples * self.rounds
    }

    /// Turquin's compensation, paths of up to 1024 bounces.
    pub(super) fn options(&self, strategy: Strategy) -> RenderOptions {
        RenderOptions {
            samples_per_pixel: self.samples,
            max_depth: 1024,
            energy: TURQUIN,
            resolution: Some([self.width, self.width * 9 / 16]),
            strategy,
            ..RenderOptions::default()
        }
    }
}

/// The result of a sampler in a room.
pub(super) struct RoomResult {
    pub(super) trial: Trial,
    /// See [`Trial::rmse`].
    pub(super) rmse: f64,
    /// See [`outlier`].
    pub(super) outlier: f64,
    pub(super) errors: Errors,
}

/// By how much the brightest pixel of a thousand is too bright, in luminance.
fn outlier(reference: &Picture, picture: &Picture) -> f64 {
    let mut apart: Vec<f32> = (picture.colour.iter().zip(&reference.colour))
        .map(|(a, b)| a.luminance() - b.luminance())
        .collect();
    apart.sort_by(f32::total_cmp);
    let at = apart.len() - 1 - apart.len() / 1000;
    f64::from(apart[at])
}

/// The name of a strategy in tables.
pub(super) fn strategy_name(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::Mis => "MIS",
        Strategy::Balance => "MIS, balance heuristic",
        Strategy::Power => "MIS, power heuristic with exponent 2",
        Strategy::LightsOnly => "lights only",
        Strategy::BsdfOnly => "lobes only",
    }
}

/// Renders a room by cap, bounded and exact sampler, in this order.
pub(super) fn render_room(
    lab: &Lab<'_>,
    room: &Room,
    budget: &Budget,
    strategy: Strategy,
    reference: &Reference,
    shares: [f64; 2],
) -> Result<Vec<RoomResult>> {
    let plan = Plan {
        options: budget.options(strategy),
        rounds: budget.rounds,
    };
    let prepared = Prepared::new(&room.scene, &CAP_BOUNDED_EXACT, &plan.options)?;
    let found = trials(lab, &prepared, &plan, shares)?;
    found
        .into_iter()
        .map(|trial| {
            let errors = errors(&reference.picture, &trial.picture)?;
            let rmse = trial.rmse(reference);
            let outlier = outlier(&reference.picture, &trial.picture);
            Ok(RoomResult {
                trial,
                rmse,
                outlier,
                errors,
            })
        })
        .collect()
}

/// Writes the pictures beside the reference.
pub(super) fn show(
    lab: &mut Lab<'_>,
    room: &Room,
    budget: &Budget,
    caption: &str,
    found: &[RoomResult],
    reference: &Reference,
) -> Result<()> {
    let inset = |[x, y, width, height]: [u32; 4]| {
        let [x, y, width, height] = [x, y, width, height].map(|n| n * budget.width / 512);
        Inset {
            x,
            y,
            width,
            height,
        }
    };
    let shot = |f: &'_ RoomResult| {
        format!(
            "{} spp, RMSE {:.4}, {:.1} s of processor time",
            budget.all_samples(),
            f.rmse,
            f.trial.seconds.iter().sum::<f64>()
        )
    };
    let shots = (found.iter())
        .map(|f| Shot {
            label: f.trial.way.name,
            picture: &f.trial.picture,
            note: shot(f),
        })
        .collect();
    lab.comparison(&PictureComparison {
        name: &room.name.replace(' ', "-"),
        caption,
        shots,
        reference: Some(&reference.picture),
        insets: room.insets.map(inset).to_vec(),
        exposure_stops: room.exposure_stops,
    })?;
    Ok(())
}

/// The table that [`add_rows`] fills.
pub(super) fn table() -> Table {
    Table::new(
        "samplers",
        "Cap, bounded and exact sampler with the same number of samples under Turquin's compensation, \
         paths of up to 1024 bounces. RMSE: without the reference's own error. Outlier: by how much \
         the brightest pixel of a thousand is too bright. Times: of the processor, in turns; quotients \
         are medians.",
        &[
            "scene",
            "strategy",
            "sampler",
            "samples [1/pixel]",
            "RMSE [radiance]",
            "RMSE over cap's",
            "standard deviation of a sample [radiance]",
            "standard errors below cap's variance",
            "outlier [radiance]",
            "fireflies [1e-6 pixels]",
            "time [s]",
            "time over cap's",
            "rays per sample",
            "rays over cap's",
            "reference's own error [radiance]",
        ],
    )
}

/// A row per sampler.
pub(super) fn add_rows(
    table: &mut Table,
    room: &Room,
    budget: &Budget,
    strategy: Strategy,
    found: &[RoomResult],
    reference: &Reference,
) {
    let Some(first) = found.first() else {
        return;
    };
    let cap = &first.trial;
    for RoomResult {
        trial,
        rmse,
        outlier,
        errors,
    } in found
    {
        table.push([
            room.name.into(),
            strategy_name(strategy).into(),
            trial.way.name.into(),
            budget.all_samples().into(),
            (*rmse).into(),
            (rmse / first.rmse).into(),
            trial.sample_deviation(budget.samples).into(),
            deviations_above(&cap.variance, &trial.variance).into(),
            (*outlier).into(),
            errors.fireflies_ppm.into(),
            trial.seconds.iter().sum::<f64>().into(),
            trial.time_ratio(cap).into(),
            mean(&trial.rays).into(),
            trial.ray_ratio(cap).into(),
            reference.square.sqrt().into(),
        ]);
    }
}
