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

use super::block::RayBlock;
use super::frame::{GROUP, RayFrame};
use super::kernel::{EntryStack, KEY_BITS, Kernel, PacketHits, STACK};
use super::node::{Child, ChildKind, Lanes, Node8, Packet8, WIDTH};
use super::traverse::{self, ClosestHit, GroupLeaves, Scene};
use super::{Hit, Ray, interleaved, tree_packs};

/// Proof that the machine has the instructions: only [`Avx2::detect`] makes one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx2 {
    /// Whether it has those of AVX-512, too, in which the same loops over sixteen lanes are compiled.
    is_wide: bool,
}

impl Avx2 {
    pub(super) fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        let is_wide = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        all.then_some(Self { is_wide })
    }

    /// The same without the instructions of AVX-512.
    #[cfg(test)]
    pub(super) fn narrow(self) -> Self {
        Self { is_wide: false }
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

    pub(super) fn intersect_block(
        self,
        scene: &Scene,
        rays: (&RayBlock, usize),
        hits: &mut [Option<Hit>],
    ) {
        // SAFETY: `self` proves that the machine has the features.
        unsafe {
            let groups = if self.is_wide {
                intersect_packs_wide(scene, rays, hits)
            } else {
                intersect_packs(scene, rays, hits)
            };
            intersect_block(self, scene, (rays.0, rays.1, groups), hits);
        }
    }

    pub(super) fn occluded_block(
        self,
        scene: &Scene,
        rays: (&RayBlock, usize),
        occluded: &mut [bool],
    ) {
        // SAFETY: `self` proves that the machine has the features.
        unsafe {
            let groups = if self.is_wide {
                occluded_packs_wide(scene, rays, occluded)
            } else {
                occluded_packs(scene, rays, occluded)
            };
            occluded_block(self, scene, (rays.0, rays.1, groups), occluded);
        }
    }
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn intersect(kernel: Avx2, scene: &Scene, ray: &Ray) -> Option<Hit> {
    traverse::intersect(kernel, scene, ray)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn occluded(kernel: Avx2, scene: &Scene, ray: &Ray) -> bool {
    traverse::occluded(kernel, scene, ray)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn intersect_at(kernel: Avx2, scene: &Scene, ray: &Ray, time: f32) -> Option<Hit> {
    traverse::intersect_at(kernel, scene, ray, time)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn occluded_at(kernel: Avx2, scene: &Scene, ray: &Ray, time: f32) -> bool {
    traverse::occluded_at(kernel, scene, ray, time)
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn intersect_block(
    kernel: Avx2,
    scene: &Scene,
    rays: (&RayBlock, usize, u32),
    hits: &mut [Option<Hit>],
) {
    interleaved::intersect(kernel, scene, rays, hits);
}

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn occluded_block(
    kernel: Avx2,
    scene: &Scene,
    rays: (&RayBlock, usize, u32),
    occluded: &mut [bool],
) {
    interleaved::occluded(kernel, scene, rays, occluded);
}

/// The packs' entries, for each set of instructions: those of AVX-512 hold sixteen lanes in a register.
macro_rules! packs {
    ($features:literal, $is_wide:literal, $intersect:ident, $occluded:ident) => {
        #[target_feature(enable = $features)]
        fn $intersect(scene: &Scene, rays: (&RayBlock, usize), hits: &mut [Option<Hit>]) -> u32 {
            let is_wide = $is_wide;
            tree_packs::intersect(Avx2 { is_wide }, scene, rays, hits)
        }

        #[target_feature(enable = $features)]
        fn $occluded(scene: &Scene, rays: (&RayBlock, usize), occluded: &mut [bool]) -> u32 {
            let is_wide = $is_wide;
            tree_packs::occluded(Avx2 { is_wide }, scene, rays, occluded)
        }
    };
}

packs!(
    "avx2,bmi1,bmi2,lzcnt,popcnt",
    false,
    intersect_packs,
    occluded_packs
);
packs!(
    "avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt",
    true,
    intersect_packs_wide,
    occluded_packs_wide
);

#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
#[inline(never)]
fn visit_below<const ANY: bool>(
    kernel: Avx2,
    leaves: &GroupLeaves<'_>,
    child: Child,
    frame: &RayFrame,
    best: &mut ClosestHit,
) -> bool {
    traverse::visit_below::<Avx2, ANY>(kernel, leaves, child, frame, best)
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
    fn push_children(
        self,
        node: &Node8,
        frame: &RayFrame,
        t_cull: f32,
        stack: &mut RawStack,
        top: usize,
    ) -> usize {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { push_children(node, frame, t_cull, stack, top) }
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

    #[inline(always)]
    fn are_at_most(self, a: &[f32; GROUP], b: &[f32; GROUP]) -> u32 {
        // SAFETY: `self` proves that the machine has the features.
        unsafe {
            if self.is_wide {
                are_at_most_wide(a, b)
            } else {
                are_at_most(a, b)
            }
        }
    }

    #[inline(always)]
    fn visit_below<const ANY: bool>(
        self,
        leaves: &GroupLeaves<'_>,
        child: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool {
        // SAFETY: `self` proves that the machine has the features.
        unsafe { visit_below::<ANY>(self, leaves, child, frame, best) }
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

/// For each set of lanes these first, then the others: a lane in each byte.
static LANES_FIRST: [u64; 1 << WIDTH] = {
    let mut table = [0; 1 << WIDTH];
    let mut set = 0;
    while set < 1 << WIDTH {
        let (mut shift, mut i) = (0, 0);
        while i < 2 * WIDTH {
            let (lane, chosen) = (i % WIDTH, i < WIDTH);
            if (set >> lane & 1 == 1) == chosen {
                table[set] |= (lane as u64) << shift;
                shift += 8;
            }
            i += 1;
        }
        set += 1;
    }
    table
};

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

/// See [`Kernel::are_at_most`].
#[target_feature(enable = "avx2")]
#[inline]
fn are_at_most(a: &[f32; GROUP], b: &[f32; GROUP]) -> u32 {
    let half = |at: usize| {
        let [a, b] = [a, b].map(|x| {
            let half: &[f32; WIDTH] = x[at..].first_chunk().unwrap_or(&[0.0; WIDTH]);
            // SAFETY: the array is 32 bytes long.
            unsafe { _mm256_loadu_ps(half.as_ptr()) }
        });
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)).cast_unsigned()
    };
    half(0) | half(WIDTH) << WIDTH
}

/// The same in one register.
#[target_feature(enable = "avx512f")]
#[inline]
fn are_at_most_wide(a: &[f32; GROUP], b: &[f32; GROUP]) -> u32 {
    // SAFETY: the arrays are 64 bytes long.
    let (a, b) = unsafe { (_mm512_loadu_ps(a.as_ptr()), _mm512_loadu_ps(b.as_ptr())) };
    u32::from(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b))
}

/// Where the ray enters and leaves the boxes of children.
#[target_feature(enable = "avx2")]
#[inline]
fn slabs(node: &Node8, frame: &RayFrame, t_cull: f32) -> [__m256; 2] {
    // With as many elements as an index may have, which needs no check then.
    let planes: &[Lanes; 8] = bytemuck::cast_ref(node);
    let origin = frame.ray.origin.to_array();
    let mut near = _mm256_setzero_ps();
    let mut far = _mm256_set1_ps(t_cull);
    for axis in 0..3 {
        let near_side = usize::from(frame.near[axis] % 8);
        let origin = _mm256_set1_ps(origin[axis]);
        let t = _mm256_sub_ps(load(&planes[near_side]), origin);
        let t = _mm256_mul_ps(t, _mm256_set1_ps(frame.near_scale[axis]));
        near = _mm256_max_ps(t, near);
        let t = _mm256_sub_ps(load(&planes[near_side ^ 1]), origin);
        let t = _mm256_mul_ps(t, _mm256_set1_ps(frame.far_scale[axis]));
        far = _mm256_min_ps(t, far);
    }
    [near, far]
}

#[target_feature(enable = "avx2")]
#[inline]
fn boxes(node: &Node8, frame: &RayFrame, t_cull: f32, entry: &mut Lanes) -> u32 {
    let [near, far] = slabs(node, frame, t_cull);
    store(entry, near);
    _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(near, far)).cast_unsigned()
}

/// The lanes that are hit come first, sorted. Lanes beyond them are written, too, above the new
/// top.
#[target_feature(enable = "avx2,popcnt")]
#[inline]
fn push_children(
    node: &Node8,
    frame: &RayFrame,
    t_cull: f32,
    stack: &mut RawStack,
    top: usize,
) -> usize {
    let [near, far] = slabs(node, frame, t_cull);
    let hit = _mm256_cmp_ps::<_CMP_LE_OQ>(near, far);
    let mask = _mm256_movemask_ps(hit).cast_unsigned() & 0xff;
    let keys = _mm256_and_si256(keys(near), _mm256_castps_si256(hit));
    let order = _mm_cvtsi64_si128(LANES_FIRST[mask as usize].cast_signed());
    let keys = _mm256_permutevar8x32_epi32(keys, _mm256_cvtepu8_epi32(order));
    let count = mask.count_ones() as usize;
    // More than four are rare.
    let keys = if count <= 4 {
        _mm256_zextsi128_si256(sorted4(_mm256_castsi256_si128(keys)))
    } else {
        sorted8(keys)
    };
    // SAFETY: the children are 32 bytes long.
    let children = unsafe { _mm256_loadu_si256(node.children.as_ptr().cast()) };
    // The last three bits of a key are its lane.
    let children = _mm256_permutevar8x32_epi32(children, keys);
    let low = _mm256_unpacklo_epi32(children, keys);
    let high = _mm256_unpackhi_epi32(children, keys);
    let above = &mut stack.0[top..top + WIDTH];
    let entries = [
        _mm256_permute2x128_si256::<0x20>(low, high),
        _mm256_permute2x128_si256::<0x31>(low, high),
    ];
    for (above, entries) in above.chunks_exact_mut(4).zip(entries) {
        // SAFETY: the slice is 32 bytes long.
        unsafe { _mm256_storeu_si256(above.as_mut_ptr().cast(), entries) };
    }
    top + count
}

/// Keys of distances: the lane in the last three bits, and a bit that makes them greater than 0.
#[target_feature(enable = "avx2")]
#[inline]
fn keys(near: __m256) -> __m256i {
    let distance = _mm256_andnot_si256(
        _mm256_set1_epi32((1 << KEY_BITS) - 1),
        _mm256_castps_si256(near),
    );
    _mm256_or_si256(distance, _mm256_setr_epi32(8, 9, 10, 11, 12, 13, 14, 15))
}

/// Four unsigned numbers in descending order, by a sorting network.
#[target_feature(enable = "avx2")]
#[inline]
fn sorted4(x: __m128i) -> __m128i {
    // Each lane and its partner: the lesser one where `$less` has a bit, else the greater one.
    macro_rules! layer {
        ($x:expr, $partner:literal, $less:literal) => {{
            let partner = _mm_shuffle_epi32::<$partner>($x);
            let (lo, hi) = (_mm_min_epu32($x, partner), _mm_max_epu32($x, partner));
            _mm_blend_epi32::<$less>(hi, lo)
        }};
    }
    let x = layer!(x, 0b01_00_11_10, 0b1100);
    let x = layer!(x, 0b10_11_00_01, 0b1010);
    layer!(x, 0b11_01_10_00, 0b0100)
}

/// Eight unsigned numbers in descending order, by Batcher's sorting network.
#[target_feature(enable = "avx2")]
#[inline]
fn sorted8(x: __m256i) -> __m256i {
    macro_rules! layer {
        ($x:expr, $partner:expr, $less:literal) => {{
            let (x, partner) = ($x, $partner);
            let (lo, hi) = (_mm256_min_epu32(x, partner), _mm256_max_epu32(x, partner));
            _mm256_blend_epi32::<$less>(hi, lo)
        }};
    }
    let x = layer!(x, _mm256_shuffle_epi32::<0b10_11_00_01>(x), 0b1010_1010);
    let x = layer!(x, _mm256_shuffle_epi32::<0b01_00_11_10>(x), 0b1100_1100);
    let x = layer!(x, _mm256_shuffle_epi32::<0b11_01_10_00>(x), 0b0100_0100);
    let x = layer!(x, _mm256_permute4x64_epi64::<0b01_00_11_10>(x), 0b1111_0000);
    let x = layer!(x, _mm256_permute4x64_epi64::<0b11_01_10_00>(x), 0b0011_0000);
    let swapped = _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 2, 1, 4, 3, 6, 5, 7));
    layer!(x, swapped, 0b0101_0100)
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
