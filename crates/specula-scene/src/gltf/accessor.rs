//! Numbers out of buffers, with every range checked.

use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::View;

use super::Reader;
use crate::error::{ErrorKind, SceneError};

/// Size of a component in bytes.
fn size(kind: DataType) -> usize {
    match kind {
        DataType::I8 | DataType::U8 => 1,
        DataType::I16 | DataType::U16 => 2,
        DataType::U32 | DataType::F32 => 4,
    }
}

/// A component as a number; integers as shares of their largest where `normalized`.
fn component(kind: DataType, bytes: &[u8], normalized: bool) -> f32 {
    let share = |value: f32, largest: f32| {
        if normalized {
            (value / largest).max(-1.0)
        } else {
            value
        }
    };
    match (kind, bytes) {
        (DataType::I8, &[a]) => share(f32::from(i8::from_le_bytes([a])), 127.0),
        (DataType::U8, &[a]) => share(f32::from(a), 255.0),
        (DataType::I16, &[a, b]) => share(f32::from(i16::from_le_bytes([a, b])), 32_767.0),
        (DataType::U16, &[a, b]) => share(f32::from(u16::from_le_bytes([a, b])), 65_535.0),
        (DataType::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
        #[allow(
            clippy::cast_precision_loss,
            reason = "attributes have no 32-bit integers"
        )]
        (DataType::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
        _ => 0.0,
    }
}

/// An unsigned integer.
fn unsigned(bytes: &[u8]) -> u32 {
    match *bytes {
        [a] => u32::from(a),
        [a, b] => u32::from(u16::from_le_bytes([a, b])),
        [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
        _ => 0,
    }
}

/// Items of a view at a stride; `None` where they end beyond it.
fn items(
    bytes: &[u8],
    offset: usize,
    stride: usize,
    size: usize,
    count: usize,
) -> Option<impl Iterator<Item = &[u8]>> {
    let last = count.checked_sub(1)?.checked_mul(stride)?;
    let end = offset.checked_add(last)?.checked_add(size)?;
    let within = bytes.get(offset..end)?;
    Some((0..count).map(move |i| &within[i * stride..i * stride + size]))
}

impl Reader<'_> {
    /// `N` numbers per element; more in the file are dropped, fewer are an error.
    pub(super) fn floats<const N: usize>(
        &self,
        what: &str,
        accessor: &gltf::Accessor<'_>,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let kind = accessor.data_type();
        let width = match accessor.dimensions() {
            Dimensions::Scalar => 1,
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            // Its columns need no padding where components have four bytes.
            Dimensions::Mat4 if N == 16 && size(kind) == 4 => N,
            Dimensions::Mat2 | Dimensions::Mat3 | Dimensions::Mat4 => 0,
        };
        if width < N {
            let message = match N {
                16 => format!("{what}: expected matrices of 4 x 4 floats"),
                _ => format!("{what}: expected vectors of {N} numbers"),
            };
            return Err(self.error(ErrorKind::Mesh, message));
        }
        self.check_count(what, accessor.count())?;
        let normalized = accessor.normalized();
        let element = |bytes: &[u8]| {
            let mut values = [0.0; N];
            for (value, bytes) in values.iter_mut().zip(bytes.chunks_exact(size(kind))) {
                *value = component(kind, bytes, normalized);
            }
            values
        };
        let bytes = width * size(kind);
        let mut values = match accessor.view() {
            Some(view) => {
                let stride = view.stride().unwrap_or(bytes).max(1);
                self.elements(
                    what,
                    &view,
                    [accessor.offset(), stride, bytes],
                    accessor.count(),
                )?
                .map(element)
                .collect()
            }
            None => vec![[0.0; N]; accessor.count()],
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, replaced) = (sparse.indices(), sparse.values());
            let index_size = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => 1,
                gltf::accessor::sparse::IndexType::U16 => 2,
                gltf::accessor::sparse::IndexType::U32 => 4,
            };
            let (index_view, value_view) = (indices.view(), replaced.view());
            let shape = [indices.offset(), index_size, index_size];
            let at = self.elements(what, &index_view, shape, sparse.count())?;
            let shape = [replaced.offset(), bytes, bytes];
            let new = self.elements(what, &value_view, shape, sparse.count())?;
            for (at, new) in at.zip(new) {
                // An index beyond the end replaces nothing.
                if let Some(value) = values.get_mut(unsigned(at) as usize) {
                    *value = element(new);
                }
            }
        }
        Ok(values)
    }

    /// Indices of vertices.
    pub(super) fn indices(
        &self,
        what: &str,
        accessor: &gltf::Accessor<'_>,
    ) -> Result<Vec<u32>, SceneError> {
        let kind = accessor.data_type();
        let unsigned_kind = matches!(kind, DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !unsigned_kind {
            let message = format!("{what}: expected unsigned integers");
            return Err(self.error(ErrorKind::Mesh, message));
        }
        self.check_count(what, accessor.count())?;
        let Some(view) = accessor.view() else {
            return Ok(vec![0; accessor.count()]);
        };
        let size = size(kind);
        let shape = [
            accessor.offset(),
            view.stride().unwrap_or(size).max(1),
            size,
        ];
        Ok(self
            .elements(what, &view, shape, accessor.count())?
            .map(unsigned)
            .collect())
    }

    /// Elements of a view: `[offset, stride, size]`, all in bytes.
    fn elements<'s>(
        &'s self,
        what: &str,
        view: &View<'_>,
        [offset, stride, size]: [usize; 3],
        count: usize,
    ) -> Result<impl Iterator<Item = &'s [u8]> + use<'s>, SceneError> {
        let bytes = self.view(what, view)?;
        items(bytes, offset, stride, size, count).ok_or_else(|| {
            let message = format!(
                "{what}: {count} elements end beyond bufferViews[{}]",
                view.index()
            );
            self.error(ErrorKind::Mesh, message)
        })
    }

    fn check_count(&self, what: &str, count: usize) -> Result<(), SceneError> {
        let most = self.limits.max_vertices;
        if count as u64 > most.saturating_mul(3) {
            let message = format!(
                "{what}: {count} elements; at most {most} vertices are read (`max_vertices`)"
            );
            return Err(self.error(ErrorKind::Limit, message));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_shares_of_their_largest() {
        assert_eq!(component(DataType::U8, &[255], true), 1.0);
        assert_eq!(component(DataType::I8, &[0x80], true), -1.0);
        assert_eq!(component(DataType::U16, &[1, 1], false), 257.0);
        assert_eq!(component(DataType::I16, &[0x01, 0x80], true), -1.0);
    }

    #[test]
    fn items_end_within_their_bytes() {
        let bytes = [0, 1, 2, 3, 4, 5, 6];
        let read = |offset, stride, size, count| {
            items(&bytes, offset, stride, size, count).map(Iterator::collect::<Vec<_>>)
        };
        assert_eq!(read(1, 3, 2, 2), Some(vec![&bytes[1..3], &bytes[4..6]]));
        assert_eq!(read(1, 3, 3, 2), Some(vec![&bytes[1..4], &bytes[4..7]]));
        assert_eq!(read(2, 3, 3, 2), None);
        assert_eq!(read(0, usize::MAX, 2, 3), None);
        assert_eq!(read(0, 1, 1, 0), None);
    }
}
