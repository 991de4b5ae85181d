//! The experiments, one file each, in the order of the papers.

mod coarse_orb;
mod cui23_densities;
mod cui23_equal_time;
mod cui23_fig1;
mod cui23_fig10_cost;
mod cui23_fig10_error;
mod cui23_fig10_histogram;
mod cui23_fig5;
mod cui23_fig6;
mod cui23_fig7;
mod cui23_fig8;
mod cui23_fig9;
mod cui23_models;
mod cui23_renders;
mod cui23_segment_terms;
mod cui23_supplement_fig1;
mod cui23_walks;
mod dupuy23_cpu_benchmark;
mod dupuy23_fig1;
mod dupuy23_gpu_benchmark;
mod dupuy23_table1;
mod eto23_fig1;
mod orb_render;
mod room_pictures;
mod sample_times;
mod sampler_trials;
mod specula_equal_time;
mod specula_furnace;
mod specula_rejection;
mod specula_variance;
pub(crate) mod stopwatch;
mod stretched_bounds;
mod tokuyoshi24_fig1;
mod tokuyoshi24_fig10;
mod tokuyoshi24_fig3;
mod tokuyoshi24_fig4;
mod tokuyoshi24_fig5;
mod tokuyoshi24_fig6;
mod tokuyoshi24_fig7;
mod tokuyoshi24_fig8;
mod tokuyoshi24_fig9;
mod tokuyoshi24_table2;
mod tokuyoshi24_table3;
mod view_grid;

use crate::{Experiment, LabError, Result};

/// All of them.
pub const ALL: &[Experiment] = &[
    tokuyoshi24_fig1::EXPERIMENT,
    tokuyoshi24_fig3::EXPERIMENT,
    tokuyoshi24_fig4::EXPERIMENT,
    tokuyoshi24_fig5::EXPERIMENT,
    tokuyoshi24_fig6::EXPERIMENT,
    tokuyoshi24_fig7::EXPERIMENT,
    tokuyoshi24_fig8::EXPERIMENT,
    tokuyoshi24_fig9::EXPERIMENT,
    tokuyoshi24_fig10::EXPERIMENT,
    tokuyoshi24_table2::EXPERIMENT,
    tokuyoshi24_table3::EXPERIMENT,
    eto23_fig1::EXPERIMENT,
    dupuy23_fig1::EXPERIMENT,
    dupuy23_cpu_benchmark::EXPERIMENT,
    dupuy23_gpu_benchmark::EXPERIMENT,
    dupuy23_table1::EXPERIMENT,
    cui23_fig1::EXPERIMENT,
    cui23_fig5::EXPERIMENT,
    cui23_fig6::EXPERIMENT,
    cui23_fig7::EXPERIMENT,
    cui23_fig8::EXPERIMENT,
    cui23_fig9::EXPERIMENT,
    cui23_fig10_cost::EXPERIMENT,
    cui23_fig10_error::EXPERIMENT,
    cui23_fig10_histogram::EXPERIMENT,
    cui23_supplement_fig1::EXPERIMENT,
    specula_furnace::EXPERIMENT,
    specula_rejection::EXPERIMENT,
    specula_variance::EXPERIMENT,
    specula_equal_time::EXPERIMENT,
];

/// The experiments of these names, in the order of [`ALL`]; all where none is given. A name ending in `*` stands for all
/// that begin with what is before.
///
/// # Errors
///
/// Where no experiment has a name.
pub fn named(names: &[String]) -> Result<Vec<&'static Experiment>> {
    for name in names {
        if !ALL.iter().any(|e| is_named(e, name)) {
            return Err(LabError::UnknownExperiment {
                name: name.clone(),
                nearest: nearest(name),
            });
        }
    }
    Ok(ALL
        .iter()
        .filter(|e| names.is_empty() || names.iter().any(|name| is_named(e, name)))
        .collect())
}

fn is_named(experiment: &Experiment, name: &str) -> bool {
    match name.strip_suffix('*') {
        Some(begin) => experiment.id.starts_with(begin),
        None => experiment.id == name,
    }
}

/// The names that share the longest beginning with `name`.
fn nearest(name: &str) -> String {
    let shared = |id: &str| {
        id.bytes()
            .zip(name.bytes())
            .take_while(|(a, b)| a == b)
            .count()
    };
    let most = ALL.iter().map(|e| shared(e.id)).max().unwrap_or(0);
    if most < 3 {
        return String::new();
    }
    let ids: Vec<&str> = ALL
        .iter()
        .map(|e| e.id)
        .filter(|id| shared(id) == most)
        .collect();
    format!(" (nearest: {})", ids.join(", "))
}
