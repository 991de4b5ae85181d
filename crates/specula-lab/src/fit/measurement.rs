//! The nodes of a measurement that a fit uses.

use specula_bsdf::Vec3;
use specula_bsdf::measured::{Measured, MeasuredNode};

/// Cosines below which directions are left out.
const LEAST_COS_O: f64 = 0.1;
const LEAST_COS_I: f64 = 0.05;
/// Of the largest value of a view: below it, values count less and less.
const FLOOR: f64 = 1e-3;
/// Where residuals begin to count by their size and not by their square.
const KNEE: f64 = 0.1;

/// A node.
pub(super) struct Node {
    pub(super) wo: Vec3<f64>,
    pub(super) wi: Vec3<f64>,
    f_cos: [f64; 3],
    /// What is added to values before their logarithms are compared.
    floor: f64,
}

/// The nodes of all views.
pub(super) struct Measurement {
    pub(super) nodes: Vec<Node>,
}

impl Measurement {
    /// `None` where there is no light.
    ///
    /// * `most`: about as many nodes as are kept, evenly.
    pub(super) fn new(measured: &Measured<f64>, most: usize) -> Option<Self> {
        let mut nodes: Vec<Node> = Vec::new();
        let mut view: Vec<MeasuredNode<f64>> = Vec::new();
        for node in measured.nodes() {
            if view.first().is_some_and(|first| first.wo != node.wo) {
                add(&mut nodes, &view);
                view.clear();
            }
            view.push(node);
        }
        add(&mut nodes, &view);
        let keep = (most as f64 / nodes.len() as f64).min(1.0);
        let mut due = 0.0;
        nodes.retain(|_| {
            due += keep;
            let kept = due >= 1.0;
            if kept {
                due -= 1.0;
            }
            kept
        });
        (!nodes.is_empty()).then_some(Self { nodes })
    }

    /// Logarithms of ratios, of what a lobe has to what was measured, per channel.
    pub(super) fn logs(node: &Node, f_cos: [f64; 3]) -> [f64; 3] {
        let ratio = |c: usize| (f_cos[c].max(0.0) + node.floor) / (node.f_cos[c] + node.floor);
        [0, 1, 2].map(|c| ratio(c).ln())
    }
}

/// A residual whose square is the loss.
pub(super) fn robust(log: f64) -> f64 {
    let scaled = log / KNEE;
    // sqrt(1 + x^2) - 1 without its cancellation.
    let rest = scaled * scaled / (1.0 + (1.0 + scaled * scaled).sqrt());
    (KNEE * (2.0 * rest).sqrt()).copysign(log)
}

fn add(nodes: &mut Vec<Node>, view: &[MeasuredNode<f64>]) {
    let channels = |n: &MeasuredNode<f64>| n.f_cos.to_array();
    let largest = view.iter().flat_map(channels).fold(0.0, f64::max);
    let usable = view.iter().filter(|n| {
        let lit = channels(n).into_iter().any(|v| v > 0.0);
        lit && n.wo.z > LEAST_COS_O && n.wi.z > LEAST_COS_I
    });
    nodes.extend(usable.map(|n| Node {
        wo: n.wo,
        wi: n.wi,
        f_cos: channels(n),
        floor: FLOOR * largest,
    }));
}
