//! Layout of the records that the renderer writes into a scene's words and shaders read: offsets of fields from a
//! record's first word, and sizes in words. Each is stated here alone, and written in front of every shader as a
//! constant of its name; [`Words::field`](crate::words::Words::field) checks it where a record is written.

use crate::codes::shared_constants;

shared_constants! {
    /// Group of shapes: offset of its vertices' positions.
    GROUP_POSITIONS = 0;
    /// How many triangles; quadrics follow them in the numbering.
    GROUP_TRIANGLE_COUNT = 1;
    /// Offset of the triangles' vertices.
    GROUP_TRIANGLES = 2;
    /// Offset of each primitive's shape.
    GROUP_SHAPE_OF = 3;
    /// Offset of each primitive's light, up to the count that follows.
    GROUP_LIGHT_OF = 4;
    /// Offset of spheres and disks.
    GROUP_QUADRICS = 6;
    /// Offset of normals, then how many vertices have them.
    GROUP_NORMALS = 7;
    /// Offset of texture coordinates, then how many vertices have them.
    GROUP_UVS = 9;
    /// Offset of second texture coordinates, then how many vertices have them.
    GROUP_SECOND_UVS = 11;
    /// Offset of tangents, then how many vertices have them.
    GROUP_TANGENTS = 13;
    /// Offset of colours, then how many vertices have them.
    GROUP_COLOURS = 15;
    /// Words of an instance.
    INSTANCE_SIZE = 39;
    /// Words of a shape.
    SHAPE_SIZE = 10;
    /// Words of a quadric.
    QUADRIC_SIZE = 40;

    /// Material: its kind.
    MATERIAL_KIND = 0;
    /// Whether its back is black.
    MATERIAL_ONE_SIDED = 1;
    /// Whether its layers transmit nothing.
    MATERIAL_OPAQUE = 2;
    /// Rotation of the tangent, in radians.
    MATERIAL_ROTATION = 3;
    /// Whether tangents do not matter.
    MATERIAL_ISOTROPIC = 4;
    /// Energy model.
    MATERIAL_ENERGY = 5;
    /// Texture of directions, or `NONE`.
    MATERIAL_DIRECTION = 6;
    /// How many parameters may have a texture; they follow.
    MATERIAL_PARAMETERS = 7;
    /// Words of a material's bump maps.
    BUMP_SIZE = 9;
    /// Words of a material's boundary.
    BOUNDARY_SIZE = 7;

    /// Words of a node of the light BVH.
    LIGHT_NODE_SIZE = 12;
    /// Light with a texture: its shape.
    TEXTURED_AREA = 6;

    /// Projected image, from its position on: the light's space from the world's.
    PROJECTED_TO_LIGHT = 3;
    /// What it goes through.
    PROJECTED_THROUGH = 15;
    /// Half the sides of its window.
    PROJECTED_HALF = 16;
    /// Cosines of a spot.
    PROJECTED_COSINES = 18;
    /// Intensity, a parameter that may have a texture.
    PROJECTED_INTENSITY = 20;

    /// Environment light, from its radiance on: the world's space from the light's.
    ENVIRONMENT_TO_WORLD = 3;
    /// The light's space from the world's.
    ENVIRONMENT_TO_LIGHT = 15;
    /// Whether it has an image; what follows is of that.
    ENVIRONMENT_IS_PICTURE = 27;
    /// Mapping of directions to the image.
    ENVIRONMENT_MAPPING = 28;
    /// Cells across.
    ENVIRONMENT_ACROSS = 29;
    /// Cells down.
    ENVIRONMENT_DOWN = 34;
    /// Offset of the cells' corners.
    ENVIRONMENT_CORNERS = 39;
    /// Offset of the rows' densities.
    ENVIRONMENT_DENSITY = 40;
    /// Offset of the distribution over rows.
    ENVIRONMENT_ROWS = 41;
    /// Offset of the distributions over columns.
    ENVIRONMENT_COLUMNS = 42;
}
