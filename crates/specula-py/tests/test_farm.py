"""`specula farm` on a cluster of two nodes, which runs in namespaces of its own."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest

import farm_cluster

SCRIPT = Path(__file__).with_name("farm_scenarios.py")


@pytest.fixture(scope="module")
def results() -> dict[str, dict[str, Any]]:
    """Run all scenarios, once."""
    if importlib.util.find_spec("ray") is None:
        pytest.skip("Ray is not installed: pip install 'ray[client]>=2.52'")
    if not farm_cluster.has_tools():
        pytest.skip("Ray runs in a network namespace, which takes unshare and ip: install iproute2")
    if farm_cluster.namespace() is None:
        pytest.skip("not of this machine: Ray runs in a network namespace, which is refused here")
    return farm_cluster.run(SCRIPT, timeout=1800.0)


@pytest.fixture
def found(results: dict[str, dict[str, Any]], request: pytest.FixtureRequest) -> Any:
    """What the scenario of the test's name found."""
    name = request.node.name.removeprefix("test_")
    assert "found" in results[name], results[name].get("error")
    return results[name]["found"]


def test_start(found: str) -> None:
    """The head says what listens where, and where its token is, not which."""
    assert "gcs_server: all interfaces, port 6399" in found
    assert "auth_token" in found and "specula farm join 127.0.0.2:6399" in found


def test_two_nodes(found: dict[str, Any]) -> None:
    """The bits of two nodes are those of one process, and nothing is rendered twice."""
    assert found == {"same": [True, True], "nodes": 2, "again": 0, "new": 16}


def test_resume(found: dict[str, Any]) -> None:
    """Ctrl-C leaves a picture and a job that can be gone on with."""
    assert (found["code"], found["picture"], found["same"]) == (130, True, True), found["said"]
    assert "specula farm resume stop.farm" in found["said"]
    assert found["finished before"] >= 2


def test_ship(found: dict[str, Any]) -> None:
    """A scene's files are sent to nodes that do not see them."""
    assert found["same"] and found["sent"] >= 1
    assert "absolute paths" in found["said"]


def test_frames(found: dict[str, Any]) -> None:
    """Frames have the bits of single renders, by frames and by samples."""
    assert found == {"same": [True] * 6, "written": ["seq.0007.png", "seq.0008.png"]}


def test_adaptive(found: dict[str, Any]) -> None:
    """Adaptive rounds over two nodes have the bits of one process."""
    assert found == {"same": [True, True]}


def test_wrong(found: list[str]) -> None:
    """What is wrong is said."""
    texts = ["Nonsense", "--energy", "a.jpg", "--frames", "no Ray cluster", "nowhere.farm"]
    assert len(found) == len(texts)
    for said, text in zip(found, texts, strict=True):
        assert said.startswith("error: ") and text in said and "Traceback" not in said


def test_client(found: dict[str, Any]) -> None:
    """The same from outside of the cluster."""
    assert found["same"] and "wants its token" in found["stranger"]


def test_gpu(found: dict[str, Any]) -> None:
    """The node that offers a GPU renders; with processors, too, both do."""
    assert found == {"same": True, "gpu": 1, "mixed": 2, "devices": ["cpu", "gpu:0"]}


def test_children(found: dict[str, Any]) -> None:
    """A renderer ends with its worker, and all end with the render."""
    assert found["killed"] >= 1 and found["code"] == 130, found["said"]


def test_kills(found: dict[str, Any]) -> None:
    """Workers and a node are killed: the same bits, and no sample is finished twice."""
    assert found["same"] and found["kills"] >= 2
    assert found["samples"] == 1536 and found["twice"] == 0
    # A node that is killed takes its parts, and what it was given before that was noticed.
    assert found["failed"] <= 3 * found["asked"]


def test_open_cluster(found: dict[str, Any]) -> None:
    """A cluster without a token is refused, and one with a token refuses those who have none."""
    assert "wants no token" in found["refused"] and "--insecure" in found["refused"]
    assert found["taken"].startswith("warning: ") or "warning: the cluster" in found["taken"]
    assert "token" in found["stranger"]


def test_local(found: dict[str, Any]) -> None:
    """Without a cluster this machine is one."""
    assert found["same"] and "token of its own" in found["said"]
