"""The papers' tables and figures, and measurements on a scene or a material of yours.

| name | is |
|---|---|
| `experiments` | all experiments: name, figure, paper, title |
| `run` | one of them: verdict, tables, figures |
| `compare` | samplers and treatments of energy on a scene |
| `material` | a material's lobe, albedo, furnace, and how its samplers do |
| `fit` | the rough metals nearest to a measured material |

They are ``specula lab`` of the command line, in a process of its own: Ctrl-C ends it.

Examples
--------
>>> from specula_render import lab
>>> result = lab.run("tokuyoshi24-fig5", progress=False)
>>> result.verdict
'reproduced'
>>> lobes = result.tables["lobes"]
>>> float(lobes["alpha"].max())
1.0
"""

from .commands import compare, experiments, fit, material, run
from .experiment import Experiment
from .result import Claim, Figure, Result
from .table import Table

__all__ = [
    "Claim",
    "Experiment",
    "Figure",
    "Result",
    "Table",
    "compare",
    "experiments",
    "fit",
    "material",
    "run",
]
