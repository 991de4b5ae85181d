"""``specula farm``: commands and options."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from specula_render.farm import cluster, listening
from specula_render.farm.cluster import ClusterError
from specula_render.farm.engine import RenderFailed
from specula_render.farm.ray_pool import NodeRefused
from specula_render.farm.request import BadRequest, Request, default_outputs
from specula_render.farm.store import JobError, Store
from specula_render.farm.worker import ProgramFailed

_WRONG = 2
_FAILED = 1
_PORT = 6379

_WITH_VALUE = [
    "clamp",
    "sampler",
    "energy",
    "material",
    "max-depth",
    "crop",
    "resolution",
    "seed",
    "share-paths",
]
"""Options of ``specula render`` that change samples."""
_OF_LOADING = [
    "missing",
    "limit-nesting",
    "limit-bytes",
    "limit-pixels",
    "limit-vertices",
    "at",
    "fps",
    "shutter",
    "animation",
]
"""Options of ``specula render`` that change what is read."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run ``specula farm`` with arguments; return the exit code."""
    parser = _parser()
    given = parser.parse_args(arguments)
    try:
        code: int = given.run(given)
        return code
    except (BadRequest, JobError, ClusterError, NodeRefused) as error:
        return _say(error, _WRONG)
    except RenderFailed as error:
        return _say(error, _WRONG if error.is_input else _FAILED)
    except (OSError, ProgramFailed) as error:
        return _say(error, _FAILED)


def _say(error: Exception, code: int) -> int:
    print(f"error: {error}", file=sys.stderr)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="specula farm",
        description="Render on many machines, or write jobs for a farm that there is.",
        allow_abbrev=False,
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _render_command(
        commands.add_parser("render", help="render on a Ray cluster", allow_abbrev=False)
    )
    resume = commands.add_parser(
        "resume", help="go on with a job that was stopped", allow_abbrev=False
    )
    resume.add_argument("job", metavar="JOB", type=Path, help="the job's folder")
    _cluster_options(resume)
    resume.set_defaults(run=_resume)
    _node_commands(commands)
    export = commands.add_parser(
        "export", help="write a job for another scheduler", allow_abbrev=False
    )
    _export_options(export)
    simulate = commands.add_parser(
        "simulate", help="simulate a farm of many nodes", allow_abbrev=False
    )
    _simulate_options(simulate)
    return parser


def _render_command(parser: argparse.ArgumentParser) -> None:
    _picture_options(parser)
    parser.add_argument(
        "--job", type=Path, help="folder of the job [default: the first output's name with .farm]"
    )
    parser.add_argument(
        "--noise", type=_positive, metavar="E", help="until the estimated relative error is E"
    )
    parser.add_argument(
        "--adaptive", action="store_true", help="more samples where there is more noise"
    )
    parser.add_argument(
        "--by", choices=["auto", "frames", "samples"], default="auto", help="what a part is"
    )
    parser.add_argument(
        "--part-time",
        type=_positive,
        metavar="S",
        help="seconds of a part [60; more where starting one is slow]",
    )
    parser.add_argument(
        "--threads", type=_count, metavar="N", help="threads of a part [default: all of its node's]"
    )
    parser.add_argument(
        "--device",
        choices=["cpu", "gpu", "mixed"],
        default="cpu",
        help="processors; GPUs where Ray reports them; or both, whose pictures differ by rounding",
    )
    parser.add_argument(
        "--ship",
        choices=["auto", "always", "never"],
        default="auto",
        help="send the scene to the nodes: where they do not see it at the same path [auto]",
    )
    _cluster_options(parser)
    parser.set_defaults(run=_render)


def _picture_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", nargs="?", metavar="SCENE", help="without one, the built-in scene")
    parser.add_argument("--spp", type=_count, required=True, metavar="N", help="samples per pixel")
    parser.add_argument(
        "--frames",
        type=_frames,
        metavar="A..B",
        help="frames A to B - 1: in place of #### in SCENE, of a glTF file's animations, or as $frame "
        "of a Mitsuba scene",
    )
    parser.add_argument(
        "-o", "--output", action="append", default=[], metavar="OUT", help="#### is the frame"
    )
    parser.add_argument(
        "--program", metavar="PATH", help="the program on the nodes [default: this package's]"
    )
    parser.add_argument(
        "--search", action="append", default=[], metavar="FOLDER", help="where files are looked for"
    )
    parser.add_argument(
        "-D",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="value of $name in Mitsuba scenes",
    )
    of_render = parser.add_argument_group("as in `specula render`")
    for name in [*_WITH_VALUE, *_OF_LOADING, "exposure", "tone"]:
        action = "append" if name == "material" else "store"
        of_render.add_argument(f"--{name}", action=action, metavar="V")
    of_render.add_argument("--regularize", action="store_true")


def _cluster_options(parser: argparse.ArgumentParser) -> None:
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--address", metavar="HOST:PORT", help="a cluster's head; or ray://HOST:PORT from outside"
    )
    which.add_argument("--local", action="store_true", help="this machine alone [default]")
    parser.add_argument("--cpus", type=_count, metavar="N", help="with --local: CPUs to use [all]")
    parser.add_argument("--insecure", action="store_true", help="use a cluster that wants no token")
    parser.add_argument("-q", "--quiet", action="store_true", help="print errors and warnings only")


def _node_commands(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    head = commands.add_parser("head", help="start a cluster, with a token", allow_abbrev=False)
    head.add_argument("--port", type=_count, default=_PORT, help=f"[{_PORT}]")
    head.add_argument("--client-port", type=_count, metavar="PORT", help="serve ray:// there")
    head.set_defaults(run=_head)
    join = commands.add_parser("join", help="add this machine to a cluster", allow_abbrev=False)
    join.add_argument("address", metavar="HOST:PORT")
    join.add_argument("--insecure", action="store_true", help="join a cluster that wants no token")
    join.set_defaults(run=_join)
    for parser in (head, join):
        parser.add_argument("--host", metavar="IP", help="this machine's address in the cluster")
        parser.add_argument("--cpus", type=_count, metavar="N", help="CPUs to offer [all]")
        parser.add_argument(
            "--gpus", type=_count, metavar="N", help="GPUs to offer [those that Ray finds]"
        )
    leave = commands.add_parser("leave", help="end all of Ray on this machine", allow_abbrev=False)
    leave.set_defaults(run=_leave)


def _export_options(parser: argparse.ArgumentParser) -> None:
    _picture_options(parser)
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--openjd", metavar="FILE", type=Path, help="an OpenJD job template")
    kind.add_argument("--slurm", metavar="FILE", type=Path, help="a Slurm array script")
    parser.add_argument(
        "--parts", type=_count, default=16, metavar="N", help="parts of a picture [16]"
    )
    parser.set_defaults(run=_export)


def _simulate_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--nodes", default="10,100,1000,10000", metavar="N,N,...", help="[10,100,1000,10000]"
    )
    parser.add_argument(
        "--hours", type=_positive, default=1.0, help="what the render takes on all nodes [1]"
    )
    parser.add_argument(
        "--film", type=_positive, default=400.0, metavar="MB", help="size of a film [400]"
    )
    parser.add_argument(
        "--load", type=_positive, default=10.0, metavar="S", help="to read the scene [10]"
    )
    parser.add_argument("--scene-size", type=_positive, default=1000.0, metavar="MB", help="[1000]")
    parser.add_argument(
        "--failures", type=float, default=1.0, metavar="N", help="per node and day [1]"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.set_defaults(run=_simulate)


def request_of(given: argparse.Namespace) -> Request:
    """Return what the options ask for."""

    def words(names: Sequence[str]) -> tuple[str, ...]:
        found: list[str] = []
        for name in names:
            value = getattr(given, name.replace("-", "_"))
            for one in value if isinstance(value, list) else [value]:
                found += [f"--{name}={one}"] if one is not None else []
        return tuple(found)

    parameters = tuple(word for value in given.D for word in ("-D", value))
    regularize = ("--regularize",) if given.regularize else ()
    return Request(
        scene=given.scene,
        spp=given.spp,
        outputs=tuple(given.output) or default_outputs(given.scene, given.frames),
        frames=given.frames,
        options=(*words(_WITH_VALUE), *regularize),
        loading=(*parameters, *words(_OF_LOADING)),
        folders=tuple(given.search),
        display=words(["exposure", "tone"]),
        program=(given.program,) if given.program else None,
    )


def _render(given: argparse.Namespace) -> int:
    from dataclasses import replace

    request = replace(
        request_of(given),
        noise=given.noise,
        adaptive=given.adaptive,
        by=given.by,
        part_seconds=given.part_time,
        threads=given.threads,
        device=given.device,
        ship=given.ship,
    )
    job = given.job or Path(re.sub(r"[.#]*\.\w+$", "", request.outputs[0]) + ".farm")
    return _run(request, job, given)


def _resume(given: argparse.Namespace) -> int:
    request = Request.from_json(Store(given.job).request())
    return _run(request, given.job, given)


def _run(request: Request, job: Path, given: argparse.Namespace) -> int:
    from specula_render.farm.render import Where, render

    where = Where(given.address, given.insecure, given.cpus)
    return render(request, job, where, quiet=given.quiet)


def _offer(given: argparse.Namespace) -> cluster.Offer:
    return cluster.Offer(given.host, given.cpus, given.gpus)


def _head(given: argparse.Namespace) -> int:
    where = cluster.ensure_token()
    cluster.start_head(_offer(given), given.port, given.client_port)
    host = given.host or "THIS-MACHINE"
    print(f"started a cluster whose token is in {where}. Listening, to those who have it:")
    for name, address in listening.sockets():
        print(f"  {name}: {address}")
    print(f"elsewhere, with the same token: specula farm join {host}:{given.port}")
    print(f"to render: specula farm render SCENE --spp N --address {host}:{given.port}")
    print("to end it: specula farm leave")
    return 0


def _join(given: argparse.Namespace) -> int:
    warning = cluster.join(given.address, _offer(given), insecure=given.insecure)
    if warning is not None:
        print(f"warning: {warning}", file=sys.stderr)
    print(f"joined {given.address}; listening:")
    for name, address in listening.sockets():
        print(f"  {name}: {address}")
    return 0


def _leave(given: argparse.Namespace) -> int:
    cluster.ray_command("stop")
    return 0


def _export(given: argparse.Namespace) -> int:
    from specula_render.farm import export

    path = given.openjd or given.slurm
    kind = "openjd" if given.openjd else "slurm"
    export.write(request_of(given), given.parts, kind, path)
    print(f"wrote {path}", file=sys.stderr)
    return 0


def _simulate(given: argparse.Namespace) -> int:
    from specula_render.farm import simulation

    nodes = [int(n) for n in given.nodes.split(",")]
    print(simulation.table(nodes, simulation.Farm.of(given)))
    return 0


def _count(text: str) -> int:
    if not text.isascii() or not text.isdigit() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"'{text}': expected a whole number above 0")
    return int(text)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < 1e12:
        raise argparse.ArgumentTypeError(f"'{text}': expected a number above 0")
    return value


def _frames(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d+)\.\.(\d+)", text)
    if found is None or int(found[1]) >= int(found[2]):
        raise argparse.ArgumentTypeError(
            f"'{text}': expected A..B with A < B, as in 0..24 for 24 frames"
        )
    return int(found[1]), int(found[2])
