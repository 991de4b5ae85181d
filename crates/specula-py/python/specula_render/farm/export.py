"""Jobs for other schedulers: an OpenJD template, a Slurm script.

Both render parts by ``specula render --samples`` and merge them. A part whose film is there is not
rendered again.
"""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

from specula_render.farm.request import BadRequest, Request, default_outputs, frame_words
from specula_render.farm.store import replace

_PADDING = re.compile("#+")


def write(request: Request, parts: int, kind: str, path: Path) -> None:
    """Write a job.

    Parameters
    ----------
    parts
        Of a picture.
    kind
        ``"openjd"`` or ``"slurm"``.

    Raises
    ------
    BadRequest
        The request cannot be written as such a job.
    """
    if request.frames is not None and request.scene is None:
        raise BadRequest("--frames needs a scene: the built-in one does not move")
    for output in request.outputs:
        if request.frames is not None and "#" not in Path(output).name:
            raise BadRequest(f"'{output}' would be every frame: put #### where its number goes")
    parts = min(parts, request.spp)
    text = openjd(request, parts) if kind == "openjd" else slurm(request, parts)
    if not path.absolute().parent.is_dir():
        raise BadRequest(f"'{path}': there is no such folder")
    replace(path, text.encode())


def openjd(request: Request, parts: int) -> str:
    """Return an OpenJD job template, in JSON."""
    program = request.program[0] if request.program else "specula"
    space = {"name": "Part", "type": "INT", "range": f"0-{parts - 1}"}
    frames = []
    if request.frames is not None:
        first, end = request.frames
        frames = [{"name": "Frame", "type": "INT", "range": f"{first}-{end - 1}"}]
    frame = "{{Task.Param.Frame}}" if frames else "0"
    begin = [
        "set -eu",
        'folder="{{Param.Folder}}"',
        'specula="{{Param.Specula}}"',
        f"frame={frame}",
    ]
    render = [*begin, "part={{Task.Param.Part}}", *_render(request, parts)]
    merge = [*begin, *_merge(request)]
    steps = [
        {"name": "Render", "parameterSpace": _space([*frames, space]), "script": _script(render)},
        {
            "name": "Merge",
            "dependencies": [{"dependsOn": "Render"}],
            **({"parameterSpace": _space(frames)} if frames else {}),
            "script": _script(merge),
        },
    ]
    for line in [*_render(request, parts), *_merge(request)]:
        if "{{" in line:
            raise BadRequest(f"'{{{{' has a meaning in OpenJD templates: {line}")
    template = {
        "specificationVersion": "jobtemplate-2023-09",
        "name": f"specula {_name(request)}"[:64],
        "parameterDefinitions": [
            {"name": "Specula", "type": "STRING", "default": program},
            {
                "name": "Folder",
                "type": "PATH",
                "objectType": "DIRECTORY",
                "dataFlow": "INOUT",
                "default": f"{_name(request)}.films",
            },
        ],
        "steps": steps,
    }
    return json.dumps(template, indent=2, ensure_ascii=False) + "\n"


def _space(definitions: list[dict[str, str]]) -> dict[str, object]:
    return {"taskParameterDefinitions": definitions}


def _script(lines: list[str]) -> dict[str, object]:
    return {
        "actions": {"onRun": {"command": "bash", "args": ["{{Task.File.Run}}"]}},
        "embeddedFiles": [{"name": "Run", "type": "TEXT", "data": "\n".join(lines) + "\n"}],
    }


def slurm(request: Request, parts: int) -> str:
    """Return a Bash script that submits an array of parts, and what merges them after it."""
    program = shlex.quote(request.program[0] if request.program else "specula")
    first, end = request.frames or (0, 1)
    folder = shlex.quote(str(Path(f"{_name(request)}.films").absolute()))
    lines = [
        "#!/usr/bin/env bash",
        f"# Renders {_name(request)} in {parts} parts a picture: `bash` with this file submits it.",
        "#SBATCH --job-name=specula",
        "#SBATCH --nodes=1 --exclusive",
        "set -eu",
        f"folder={folder}",
        f"specula=${{SPECULA:-{program}}}",
        f"parts={parts} first={first} frames={end - first}",
        "submit() {",
        '  id=$(sbatch --parsable --array=0-$((frames * parts - 1)) "$0" render)',
        '  sbatch --dependency=afterok:"${id%%;*}" --array=0-$((frames - 1)) "$0" merge',
        "}",
        "render() {",
        "  frame=$((first + SLURM_ARRAY_TASK_ID / parts)) part=$((SLURM_ARRAY_TASK_ID % parts))",
        *[f"  {line}" for line in _render(request, parts)],
        "}",
        "merge() {",
        "  frame=$((first + SLURM_ARRAY_TASK_ID))",
        *[f"  {line}" for line in _merge(request)],
        "}",
        '"${1:-submit}"',
    ]
    return "\n".join(lines) + "\n"


def _name(request: Request) -> str:
    return Path(default_outputs(request.scene, None)[0]).stem


def _render(request: Request, parts: int) -> list[str]:
    """Return the lines that render a part, by ``folder``, ``specula``, ``frame`` and ``part``."""
    command = ['"$specula"', "render"]
    if request.scene is not None:
        command.append(_numbered(str(Path(request.scene).absolute())))
        if request.frames is not None and "#" not in Path(request.scene).name:
            option, value = frame_words(request.scene, "$frame")
            command += [option, f'"{value}"']
    searched = [w for f in request.folders for w in ("--search", str(Path(f).absolute()))]
    command += [shlex.quote(w) for w in (*request.loading, *request.options, *searched)]
    spp = request.spp
    return [
        'mkdir -p "$folder"',
        f"from=$((part * {spp} / {parts})) to=$(((part + 1) * {spp} / {parts}))",
        'film="$folder/$(printf %05d-%08d "$frame" "$from").film"',
        '[ -e "$film" ] || '
        + " ".join([*command, '--samples "$from..$to"', "--checkpoint off", '-q -o "$film"']),
    ]


def _merge(request: Request) -> list[str]:
    """Return the lines that merge a picture's films."""
    outputs = [f"-o {_numbered(str(Path(o).absolute()))}" for o in request.outputs]
    display = [shlex.quote(word) for word in request.display]
    films = '"$folder/$(printf %05d "$frame")"-*.film'
    return [" ".join(['"$specula" merge', films, "-q", *display, *outputs])]


def _numbered(path: str) -> str:
    """Return a path for the shell, with the frame's number in place of ``###`` in its name."""
    folder, name = str(Path(path).parent), Path(path).name
    found = _PADDING.search(name)
    if found is None:
        return shlex.quote(path)
    before, after = f"{folder}/{name[: found.start()]}", name[found.end() :]
    number = f'"$(printf %0{len(found.group())}d "$frame")"'
    return f"{shlex.quote(before)}{number}{shlex.quote(after)}"
