"""Pictures with their noise, compared by tiles, and sheets that show them side by side.

Needs numpy and mitsuba (for EXR and PNG files).
"""
import mitsuba as mi
import numpy as np

if not mi.variant():
    mi.set_variant("scalar_rgb")

TILE = 8
# Tiles darker than this part of the picture's mean are measured against it.
FLOOR = 0.01


def load(path):
    """Colour, and variance of each pixel's mean where the file has it: (h, w, 3) each."""
    layers = np.array(mi.Bitmap(str(path)), dtype=np.float64)
    names = [field.name for field in mi.Bitmap(str(path)).struct_()]
    pick = lambda wanted: layers[:, :, [names.index(n) for n in wanted]]
    colour = pick("RGB") if "R" in names else np.repeat(layers[:, :, :1], 3, axis=2)
    if "variance.R" not in names:
        return colour, None
    return colour, pick(["variance.R", "variance.G", "variance.B"])


def of_runs(pictures):
    """Mean of independent pictures, and the variance of that mean."""
    pictures = np.array(pictures)
    return pictures.mean(0), pictures.var(0, ddof=1) / len(pictures)


def tiles(picture):
    """Means of the tiles that are whole: (h / 8, w / 8, 3)."""
    h, w = picture.shape[0] // TILE * TILE, picture.shape[1] // TILE * TILE
    blocks = picture[:h, :w].reshape(h // TILE, TILE, w // TILE, TILE, 3)
    return blocks.mean((1, 3))


def compare(own, theirs):
    """Numbers of the table; each picture is (colour, variance).

    ratio, ratio_error: of the means, per channel, and its standard error; tile_ratio: the median of
    the tiles' ratios; median, p95: of the tiles' differences, summed over the channels, relative to
    theirs; noise: what the median would be if noise were all; z_rms: root mean square of the tiles'
    differences over their standard errors, 1 where noise is all.
    """
    (a, var_a), (b, var_b) = own, theirs
    ta, tb = tiles(a), tiles(b)
    level = np.maximum(tb.sum(2), FLOOR * b.sum(2).mean())
    lit = tb.sum(2) >= level
    difference = np.abs(ta - tb).sum(2) / level
    result = {
        "ratio": [round(float(x), 4) for x in a.mean((0, 1)) / np.maximum(b.mean((0, 1)), 1e-30)],
        "tile_ratio": [round(float(x), 4) for x in np.median(ta[lit] / np.maximum(tb[lit], 1e-30), axis=0)],
        "median": round(float(np.median(difference)), 4),
        "p95": round(float(np.percentile(difference, 95)), 4),
        "worst": [int(i) for i in np.unravel_index(difference.argmax(), difference.shape)],
    }
    if var_a is None or var_b is None:
        return result
    total = np.sqrt((var_a + var_b).sum((0, 1))) / a[:, :, 0].size
    result["ratio_error"] = [round(float(x), 4) for x in total / np.maximum(b.mean((0, 1)), 1e-30)]
    variance = (tiles(var_a) + tiles(var_b)) / TILE**2
    deviation = np.sqrt(np.maximum(variance, 1e-20))
    # Of |a - b| summed over the channels, if noise were all: a normal variable's mean magnitude.
    result["noise"] = round(float(np.median(0.8 * deviation.sum(2) / level)), 4)
    z = (ta - tb) / np.sqrt(np.maximum(variance, 1e-12 + (1e-4 * level[:, :, None]) ** 2))
    result["z_rms"] = round(float(np.sqrt(np.mean(np.minimum(np.abs(z), 30) ** 2))), 2)
    result["z_above_4"] = round(float((np.abs(z) > 4).mean()), 4)
    return result


def shown(picture, exposure=1.0):
    """sRGB bytes of linear values."""
    x = np.clip(picture * exposure, 0, 1)
    return (np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055) * 255 + 0.5).astype(
        np.uint8
    )


def exposure_of(picture):
    """Shows the 90th percentile at 0.7."""
    return 0.7 / max(float(np.percentile(picture.max(2), 90)), 1e-9)


def sheet(path, own, theirs, exposure=None, span=0.2, zoom=2):
    """Specula's, the peer's, and the tiles' relative difference: blue where specula's is darker, red where it is
    brighter, full colour at `span`. Pixels are `zoom` wide."""
    exposure = exposure or exposure_of(theirs)
    ta, tb = tiles(own).sum(2), tiles(theirs).sum(2)
    relative = (ta - tb) / np.maximum(tb, FLOOR * theirs.sum(2).mean()) / span
    relative = np.clip(np.repeat(np.repeat(relative, TILE, 0), TILE, 1), -1, 1)
    difference = np.stack(
        [1 + np.minimum(relative, 0), 1 - np.abs(relative), 1 - np.maximum(relative, 0)], axis=2
    )
    full = np.ones_like(own)
    full[: difference.shape[0], : difference.shape[1]] = difference
    gap = np.ones((own.shape[0], 4, 3))
    row = [shown(own, exposure), shown(gap), shown(theirs, exposure), shown(gap), shown(full)]
    row = np.concatenate(row, axis=1).repeat(zoom, axis=0).repeat(zoom, axis=1)
    mi.Bitmap(np.ascontiguousarray(row)).write(str(path))
