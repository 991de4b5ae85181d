// A rough metal: GGX, Smith's height-correlated masking, Schlick's reflectance of gold.
// parameters.xy: alpha along x and y.

const F0 = vec3f(1.0, 0.78, 0.34);
const TURN = 6.2831853;

fn stretched(w: vec3f) -> f32 {
    return length(vec3f(parameters.xy * w.xy, w.z));
}

// D(m): density of normals.
fn distribution(m: vec3f) -> f32 {
    let s = vec3f(m.xy / parameters.xy, m.z);
    let squared = dot(s, s);
    return 2.0 / (TURN * parameters.x * parameters.y * squared * squared);
}

// G1: the share of facets that a direction sees.
fn masking(w: vec3f) -> f32 {
    return 2.0 * w.z / (w.z + stretched(w));
}

// G2: the share that both directions see.
fn masking_both(wo: vec3f, wi: vec3f) -> f32 {
    return 2.0 * wo.z * wi.z / (wi.z * stretched(wo) + wo.z * stretched(wi));
}

fn reflectance(cosine: f32) -> vec3f {
    let c = 1.0 - clamp(cosine, 0.0, 1.0);
    return F0 + (1.0 - F0) * (c * c * c * c * c);
}

fn user_eval(wo: vec3f, wi: vec3f) -> vec3f {
    if wo.z <= 0.0 || wi.z <= 0.0 {
        return vec3f(0.0);
    }
    let m = normalize(wo + wi);
    return reflectance(dot(wo, m)) * (distribution(m) * masking_both(wo, wi) / (4.0 * wo.z));
}

fn user_pdf(wo: vec3f, wi: vec3f) -> f32 {
    if wo.z <= 0.0 || wi.z <= 0.0 {
        return 0.0;
    }
    let m = normalize(wo + wi);
    let visible = masking(wo) * distribution(m) * dot(wo, m) / wo.z;
    return visible / (4.0 * dot(wo, m));
}

// Visible normals by spherical caps (Dupuy and Benyoub 2023).
fn user_sample(wo: vec3f, u: vec3f) -> vec4f {
    if wo.z <= 0.0 {
        return vec4f(0.0);
    }
    let alpha = parameters.xy;
    let view = normalize(vec3f(alpha * wo.xy, wo.z));
    let z = (1.0 - u.y) * (1.0 + view.z) - view.z;
    let radius = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    let h = vec3f(radius * cos(TURN * u.x), radius * sin(TURN * u.x), z) + view;
    let m = normalize(vec3f(alpha * h.xy, max(h.z, 0.0)));
    let wi = 2.0 * dot(wo, m) * m - wo;
    if wi.z <= 0.0 {
        return vec4f(0.0);
    }
    return vec4f(wi, user_pdf(wo, wi));
}
