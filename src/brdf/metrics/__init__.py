"""How far one reflectance is from another: in pictures of a sphere, and over pairs of directions.

The picture protocol, used for every PSNR the package quotes: an orthographic view of a sphere, one light at angles
0, 5, …, 175 degrees from the viewer, radiance pi f cos(theta_i) (a white diffuser facing the light shows 1), pixels
that are lit and visible only. PSNR compares the sRGB values of the radiance clamped to [0, 1], CIEDE2000 its colours in
CIELAB under D65; the relative RMSE compares the unclamped radiance, ||a - b|| / ||a||. All pool pixels, channels and
light angles, unless they say that they take each light by itself.

Delta distributions (mirrors) show in no picture and at no pair of directions: they count in the albedo alone.
"""

from .albedo import ALBEDO_ANGLES, directional_albedo
from .comparison import RANKINGS, Comparison, compare, rank
from .importance import Errors, ErrorsAgainst, display_rms, importance_errors, importance_pairs, relative_rms
from .pairs import (
    LOG_OFFSET,
    METRICS,
    Metric,
    Pairs,
    cosine_weighted_l2,
    cube_root,
    direction_metrics,
    direction_pairs,
    error_map,
    log_relative,
    logarithmic,
)
from .sphere import (
    LIGHT_ANGLES,
    SPHERE_SIZE,
    DeltaE,
    delta_e,
    delta_e_of,
    psnr,
    psnr_by_angle,
    psnr_by_light,
    psnr_of,
    relative_rmse,
    relative_rmse_of,
    sphere_lights,
    sphere_pairs,
    sphere_radiance,
)
from .surroundings import lit_from_all_around

__all__ = [
    "ALBEDO_ANGLES", "LIGHT_ANGLES", "LOG_OFFSET", "METRICS", "RANKINGS", "SPHERE_SIZE", "Comparison", "DeltaE",
    "Errors", "ErrorsAgainst", "Metric", "Pairs", "compare", "cosine_weighted_l2", "cube_root", "delta_e",
    "delta_e_of", "direction_metrics", "direction_pairs", "directional_albedo", "display_rms", "error_map",
    "importance_errors", "importance_pairs", "lit_from_all_around", "log_relative", "logarithmic", "psnr",
    "psnr_by_angle", "psnr_by_light", "psnr_of", "rank", "relative_rms", "relative_rmse", "relative_rmse_of",
    "sphere_lights", "sphere_pairs", "sphere_radiance",
]  # fmt: skip
