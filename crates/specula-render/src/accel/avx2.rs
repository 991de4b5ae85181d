//! The AVX2 kernel: the one place of the renderer with `unsafe`.
//!
//! Operation by operation the same as [`super::kernel::Portable`]: no fused multiply-add, operands of
//! `min` and `max` in the same order. A test holds the two together bit for bit.
#![allow(
    unsafe_code,
    reason = "vector instructions chosen at run time, and a stack that is not cleared per ray"
)]

use std::arch::x86_64::*;
use std::mem::MaybeUninit;

use super::block::Rays;
use super::frame::RayFrame;
use super::kernel::{EntryStack, Kernel, PacketHits, STACK};
use super::node::{Child, ChildKind, Lanes, Node8, Packet8};
use super::traverse::{self, Scene};
use super::{Hit, Ray, interleaved};

/// Proof that the machine has the instructions: only [`Avx2::detect`] makes one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx2(());

impl Avx2 {
    pub(super) fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt");
        all.then_some(Self(()))
    }

    #[inline(always)]
    pub(super) fn intersect(self, scene: &Scene, ray: &Ray) -> Option<Hit> {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { intersect(self, scene, ray) }
    }

    #[inline(always)]
    pub(super) fn occluded(self, scene: &Scene, ray: &Ray) -> bool {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { occluded(self, scene, ray) }
    }

    #[inline(always)]
    pub(super) fn intersect_at(self, scene: &Scene, ray: &Ray, time: f32) -> Option<Hit> {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { intersect_at(self, scene, ray, time) }
    }

    #[inline(always)]
    pub(super) fn occluded_at(self, scene: &Scene, ray: &Ray, time: f32) -> bool {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { occluded_at(self, scene, ray, time) }
    }

    pub(super) fn intersect_interleaved<R: Rays + ?Sized>(
        self,
        scene: &Scene,
        rays: &R,
        hits: &mut [Option<Hit>],
    ) {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { intersect_interleaved(self, scene, rays, hits) }
    }

    pub(super) fn occluded_interleaved<R: Rays + ?Sized>(
        self,
        scene: &Scene,
        rays: &R,
        occluded: &mut [bool],
    ) {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { occluded_interleaved(self, scene, rays, occluded) }
    }
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn intersect(kernel: Avx2, scene: &Scene, ray: &Ray) -> Option<Hit> {
    traverse::intersect(kernel, scene, ray)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn occluded(kernel: Avx2, scene: &Scene, ray: &Ray) -> bool {
    traverse::occluded(kernel, scene, ray)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn intersect_at(kernel: Avx2, scene: &Scene, ray: &Ray, time: f32) -> Option<Hit> {
    traverse::intersect_at(kernel, scene, ray, time)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn occluded_at(kernel: Avx2, scene: &Scene, ray: &Ray, time: f32) -> bool {
    traverse::occluded_at(kernel, scene, ray, time)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn intersect_interleaved<R: Rays + ?Sized>(
    kernel: Avx2,
    scene: &Scene,
    rays: &R,
    hits: &mut [Option<Hit>],
) {
    interleaved::intersect(kernel, scene, rays, hits);
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn occluded_interleaved<R: Rays + ?Sized>(
    kernel: Avx2,
    scene: &Scene,
    rays: &R,
    occluded: &mut [bool],
) {
    interleaved::occluded(kernel, scene, rays, occluded);
}

/// A stack whose entries are not initialised until they are written.
pub(super) struct RawStack([MaybeUninit<u64>; STACK]);

impl EntryStack for RawStack {
    #[inline(always)]
    fn set(&mut self, at: usize, entry: u64) {
        self.0[at].write(entry);
    }

    #[inline(always)]
    fn get(&self, at: usize) -> u64 {
        // SAFETY: the traversal reads only entries below its top, all of which it has written.
        unsafe { self.0[at].assume_init() }
    }
}

impl Kernel for Avx2 {
    type Stack = RawStack;

    #[inline(always)]
    fn stack(self) -> RawStack {
        RawStack([MaybeUninit::uninit(); STACK])
    }

    #[inline(always)]
    fn prefetch(self, scene: &Scene, child: Child) {
        match child.kind() {
            ChildKind::Node => prefetch(&scene.nodes[child.index()]),
            ChildKind::Packet => prefetch(&scene.packets[child.index()]),
            ChildKind::Quadric | ChildKind::PatchOrPlacement | ChildKind::CurvePart => {}
        }
    }

    #[inline(always)]
    fn boxes(self, node: &Node8, frame: &RayFrame, t_cull: f32, entry: &mut Lanes) -> u32 {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { boxes(node, frame, t_cull, entry) }
    }

    #[inline(always)]
    fn triangles(
        self,
        packet: &Packet8,
        frame: &RayFrame,
        t_most: f32,
        hits: &mut PacketHits,
    ) -> u32 {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { triangles(packet, frame, t_most, hits) }
    }
}

/// All lines of the cache that a value lies in.
#[inline(always)]
fn prefetch<T>(value: &T) {
    let start = std::ptr::from_ref(value).cast::<i8>();
    for offset in (0..size_of::<T>()).step_by(64) {
        // SAFETY: prefetching reads nothing, and the address is within the value.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(start.add(offset)) };
    }
}

#[target_feature(enable = "avx2")]
#[inline]
fn load(lanes: &Lanes) -> __m256 {
    // SAFETY: `Lanes` is 32 bytes long and aligned to 32.
    unsafe { _mm256_load_ps(lanes.0.as_ptr()) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn store(lanes: &mut Lanes, values: __m256) {
    // SAFETY: `Lanes` is 32 bytes long and aligned to 32.
    unsafe { _mm256_store_ps(lanes.0.as_mut_ptr(), values) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn boxes(node: &Node8, frame: &RayFrame, t_cull: f32, entry: &mut Lanes) -> u32 {
    let mut near = _mm256_setzero_ps();
    let mut far = _mm256_set1_ps(t_cull);
    for axis in 0..3 {
        let near_side = usize::from(frame.near[axis]);
        let origin = _mm256_set1_ps(frame.origin[axis]);
        let near_scale = _mm256_set1_ps(frame.near_scale[axis]);
        let far_scale = _mm256_set1_ps(frame.far_scale[axis]);
        let t = _mm256_mul_ps(
            _mm256_sub_ps(load(&node.bounds[near_side]), origin),
            near_scale,
        );
        near = _mm256_max_ps(t, near);
        let t = _mm256_mul_ps(
            _mm256_sub_ps(load(&node.bounds[near_side ^ 1]), origin),
            far_scale,
        );
        far = _mm256_min_ps(t, far);
    }
    store(entry, near);
    _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(near, far)).cast_unsigned()
}

/// `a0 b1 - a1 b0`, see [`super::triangle::edge_functions`].
#[target_feature(enable = "avx2")]
#[inline]
fn edge(a: [__m256; 3], b: [__m256; 3]) -> __m256 {
    _mm256_sub_ps(_mm256_mul_ps(a[0], b[1]), _mm256_mul_ps(a[1], b[0]))
}

/// One corner of each triangle, see [`super::triangle::shear`].
#[target_feature(enable = "avx2")]
#[inline]
fn shear(corner: &[Lanes; 3], frame: &RayFrame) -> [__m256; 3] {
    let [x, y, z] = frame.axes.map(usize::from);
    let o = frame.sheared_origin;
    let z = _mm256_sub_ps(load(&corner[z]), _mm256_set1_ps(o[2]));
    let x = _mm256_sub_ps(load(&corner[x]), _mm256_set1_ps(o[0]));
    let y = _mm256_sub_ps(load(&corner[y]), _mm256_set1_ps(o[1]));
    [
        _mm256_sub_ps(x, _mm256_mul_ps(_mm256_set1_ps(frame.shear[0]), z)),
        _mm256_sub_ps(y, _mm256_mul_ps(_mm256_set1_ps(frame.shear[1]), z)),
        z,
    ]
}

/// See [`super::triangle::inside`] and [`super::triangle::distance`].
#[target_feature(enable = "avx2")]
#[inline]
fn triangles(packet: &Packet8, frame: &RayFrame, t_most: f32, hits: &mut PacketHits) -> u32 {
    let a = shear(&packet.vertices[0], frame);
    let b = shear(&packet.vertices[1], frame);
    let c = shear(&packet.vertices[2], frame);
    let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
    let det = _mm256_add_ps(_mm256_add_ps(u, v), w);
    let zero = _mm256_setzero_ps();
    let lo = _mm256_min_ps(u, _mm256_min_ps(v, w));
    let hi = _mm256_max_ps(u, _mm256_max_ps(v, w));
    let inside = _mm256_and_ps(
        _mm256_or_ps(
            _mm256_cmp_ps::<_CMP_GE_OQ>(lo, zero),
            _mm256_cmp_ps::<_CMP_LE_OQ>(hi, zero),
        ),
        _mm256_cmp_ps::<_CMP_NEQ_UQ>(det, zero),
    );
    if _mm256_movemask_ps(inside) == 0 {
        return 0;
    }
    let (u, v, w) = (
        _mm256_div_ps(u, det),
        _mm256_div_ps(v, det),
        _mm256_div_ps(w, det),
    );
    let t = _mm256_add_ps(
        _mm256_add_ps(_mm256_mul_ps(u, a[2]), _mm256_mul_ps(v, b[2])),
        _mm256_mul_ps(w, c[2]),
    );
    let t = _mm256_mul_ps(t, _mm256_set1_ps(frame.shear[2]));
    let inside = _mm256_and_ps(
        inside,
        _mm256_and_ps(
            _mm256_cmp_ps::<_CMP_GT_OQ>(t, zero),
            _mm256_cmp_ps::<_CMP_LE_OQ>(t, _mm256_set1_ps(t_most)),
        ),
    );
    store(&mut hits.t, t);
    store(&mut hits.u, v);
    store(&mut hits.v, w);
    _mm256_movemask_ps(inside).cast_unsigned()
}
