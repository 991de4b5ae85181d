//! Planted faults, and functions that cases run without naming them.

use crate::harness::{Fault, fault};

/// Functions that no body names, with the cases that run them.
pub(super) const ELSEWHERE: &[(&str, &str)] = &[
    (
        "cui_bidirectional_value",
        "cui2023_subpath cui2023_path_over_density cui2023_fly cui2023_rivals cui2023_rivals_along
         cui2023_roulette",
    ),
    (
        "heitz_value and heitz_sample",
        "heitz2016_step heitz2016_depth",
    ),
    (
        "heitz_interface_value and heitz_interface_sample",
        "heitz_interface_eval heitz_interface_sample heitz_interface_left heitz_interface_collisions
         heitz_interface_after heitz_interface_flown multibounce_interface_connection
         multibounce_interface_leaves multibounce_interface_lambda
         multibounce_dielectric_is_index_matched multibounce_dielectric_is_turned
         multibounce_dielectric_side multibounce_dielectric_upright",
    ),
    (
        "stratified_bidirectional_interface_value and stratified_bidirectional_interface_sample",
        "stratified_bidirectional_interface_eval stratified_bidirectional_interface_is_better_end stratified_bidirectional_interface_eval_end
         stratified_bidirectional_interface_walk stratified_bidirectional_interface_sample",
    ),
    (
        "mis_lambert and mis_hapke",
        "mis_pdf_first_facet mis_pdf_hapke",
    ),
    (
        "interface_lambert and interface_normalised",
        "mis_pdf_lambert_share mis_pdf_interface multibounce_interface_phase",
    ),
    (
        "conductor_value and conductor_sample",
        "multibounce_conductor_eval multibounce_conductor_pdf multibounce_conductor_walk",
    ),
    (
        "a pair of functions that cases name",
        "multibounce_dielectric_eval_pdf",
    ),
    (
        "diffuse_value and diffuse_sample",
        "multibounce_diffuse_eval multibounce_diffuse_scatter multibounce_diffuse_pdf",
    ),
    (
        "interface_masking",
        "multibounce_interface_log_above multibounce_interface_binet",
    ),
    (
        "mis_normalised and normalised_directions",
        "normalised_takes normalised_sent normalised_rolled_sent normalised_met normalised_low
         normalised_opposite normalised_flight normalised_view normalised_stays
         normalised_to_grain normalised_maps_odds normalised_maps_odds_inverse
         normalised_maps_at normalised_maps_horizontal normalised_maps_turn
         normalised_maps_rise_back normalised_maps_rise_send normalised_maps_rolled
         normalised_maps_roll_back normalised_maps_roll_send normalised_lobes_cumulative
         normalised_lobes_inverse normalised_lobes_round normalised_lobes_round_density
         normalised_lobes_round_direction normalised_lobes_cone normalised_lobes_cone_density
         normalised_lobes_cone_direction",
    ),
    ("stratified_bidirectional_value", "stratified_bidirectional_stratum stratified_bidirectional_goes_on stratified_bidirectional_walk"),
    ("wang_value and wang_sample", "wang2022_leaves"),
];

/// One at least for every module.
pub(crate) const FAULTS: &[Fault] = &[
    fault(
        "states",
        "multibounce/state",
        "carry = l * r;",
        "carry = 1.0001 * l * r;",
    ),
    fault(
        "meetings",
        "multibounce/walk",
        "2.0 * along",
        "2.0001 * along",
    ),
    fault(
        "normals_of_both",
        "multibounce/normals",
        "return beckmann_projected_area(",
        "return 1.0001 * beckmann_projected_area(",
    ),
    fault(
        "heitz_value",
        "multibounce/heitz2016",
        "exp(-(tau * leaving.rate))",
        "exp(-(1.01 * tau * leaving.rate))",
    ),
    fault(
        "bitterli_value",
        "multibounce/bitterli2022",
        ">= staying",
        ">= 0.95 * staying",
    ),
    fault(
        "wang_value",
        "multibounce/wang2022",
        "against / (against + outgoing)",
        "against / (against + 1.01 * outgoing)",
    ),
    fault(
        "cui_value",
        "multibounce/cui2023",
        "CUI2023_GOES_ON: f32 = 0.7;",
        "CUI2023_GOES_ON: f32 = 0.71;",
    ),
    fault(
        "cui_bidirectional_value",
        "multibounce/cui2023",
        "0.25 * normals_d",
        "0.26 * normals_d",
    ),
    fault(
        "stratified_bidirectional_value",
        "multibounce/stratified_bidirectional",
        "STRATIFIED_BIDIRECTIONAL_CARRIED: f32 = 0.5;",
        "STRATIFIED_BIDIRECTIONAL_CARRIED: f32 = 0.51;",
    ),
    fault(
        "mis_normalised",
        "multibounce/normalised",
        "1.72 * smooth_part",
        "1.74 * smooth_part",
    ),
    fault(
        "mis_normalised",
        "multibounce/normalised_maps",
        "ROLLED_UP: f32 = 0.88;",
        "ROLLED_UP: f32 = 0.9;",
    ),
    fault(
        "mis_normalised",
        "multibounce/normalised_lobes",
        "-1.02 * wo.x",
        "-1.03 * wo.x",
    ),
    fault("mis_hapke", "multibounce/mis_pdf", "0.975", "0.974"),
    fault(
        "interface_masking",
        "multibounce/multibounce_interface",
        "-0.08106146679532726",
        "-0.0811",
    ),
    fault(
        "interface_lambert",
        "multibounce/multibounce_interface",
        "0.25 * bent.reflectance",
        "0.2501 * bent.reflectance",
    ),
    fault(
        "heitz_interface_value",
        "multibounce/heitz_interface",
        "next.is_beyond = !walk.is_beyond;",
        "next.is_beyond = true;",
    ),
    fault(
        "stratified_bidirectional_interface_value",
        "multibounce/stratified_bidirectional_interface",
        "1.02 - 0.22",
        "1.2 - 0.22",
    ),
    fault(
        "heitz_interface_value",
        "multibounce/multibounce_dielectric",
        "return lobe.tints.reflection * f_cos",
        "return lobe.tints.transmission * f_cos",
    ),
    fault(
        "conductor_value",
        "multibounce/multibounce_conductor",
        "heitz2016_eval(lobe.facets, true",
        "heitz2016_eval(lobe.facets, false",
    ),
    fault(
        "diffuse_value",
        "multibounce/multibounce_diffuse",
        "cos_i * 0.31830987",
        "cos_i * 0.32",
    ),
];
