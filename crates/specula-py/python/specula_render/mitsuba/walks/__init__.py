"""Walks between the facets of a rough surface: estimators of multiple bounces, one file per model.

`facets`, `interface` and `depth_state` hold what they share. An estimator of a metal has two
functions,

    eval(facets, wi, wo, rng, active)     an estimate of f cos, both directions above the horizon
    sample(facets, wi, u, rng, active)    a direction and its weight; `u` takes the first facet

and samples a direction below the horizon, or a weight of 0, where a walk does not leave.

Source: `crates/specula-bsdf/src/multibounce`, whose files have the same names.
"""
