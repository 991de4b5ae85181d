//! Conversions from and to the types of glam.

use super::{Frame, Vec3, vec3};

macro_rules! convert {
    ($t:ident: $vector:ty, $matrix:ty) => {
        impl From<$vector> for Vec3<$t> {
            #[inline(always)]
            fn from(v: $vector) -> Self {
                vec3(v.x, v.y, v.z)
            }
        }

        impl From<Vec3<$t>> for $vector {
            #[inline(always)]
            fn from(v: Vec3<$t>) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }

        /// Columns `s`, `t` and `n`: local to world.
        impl From<Frame<$t>> for $matrix {
            #[inline(always)]
            fn from(frame: Frame<$t>) -> Self {
                Self::from_cols(frame.s.into(), frame.t.into(), frame.n.into())
            }
        }

        /// * `m`: a rotation; its columns become `s`, `t` and `n`.
        impl From<$matrix> for Frame<$t> {
            #[inline(always)]
            fn from(m: $matrix) -> Self {
                Self {
                    s: m.x_axis.into(),
                    t: m.y_axis.into(),
                    n: m.z_axis.into(),
                }
            }
        }
    };
}

convert!(f32: glam::Vec3, glam::Mat3);
convert!(f64: glam::DVec3, glam::DMat3);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_the_same_and_a_frame_is_its_matrix() {
        let v = vec3(1.0_f32, -2.0, 3.0);
        assert_eq!(Vec3::from(glam::Vec3::from(v)), v);
        let n = vec3(0.6_f64, 0.0, 0.8);
        let frame = Frame::from_normal(n);
        let matrix = glam::DMat3::from(frame);
        assert_eq!(Frame::from(matrix), frame);
        let w = vec3(0.1, 0.2, 0.3);
        let got: Vec3<f64> = (matrix * glam::DVec3::from(w)).into();
        assert!((got - frame.to_world(w)).length() < 1e-15);
    }
}
