"""A native run can be watched and interrupted."""

from __future__ import annotations

import _thread
import signal
import threading
import time
from collections.abc import Iterator

import numpy as np
import pytest

import acausal as ac

from .models import Decay


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Decay())


@pytest.fixture(autouse=True)
def interrupts() -> Iterator[None]:
    """They arrive, although a shell starts what it puts into the background without them."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


ENDLESS = {"solver": "rk4", "dt": 1e-9, "saveat": 2, "max_steps": 10**10}
"""Ten thousand million steps."""


def test_interrupt_ends_the_run(system: ac.System) -> None:
    system.simulate(1e-6, **ENDLESS)
    threading.Timer(0.2, _thread.interrupt_main).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        system.simulate(10.0, **ENDLESS)
    assert time.monotonic() - begin < 20.0
    np.testing.assert_allclose(system.simulate(1.0, saveat=2)["x"][-1], 2 * np.exp(-0.7), rtol=1e-5)


def test_interrupt_ends_an_ensemble(system: ac.System) -> None:
    system.ensemble({"k": [0.5, 0.6]}, 1e-6, **ENDLESS)  # imports may swallow an interrupt
    threading.Timer(0.5, _thread.interrupt_main).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        system.ensemble({"k": [0.5, 0.6, 0.7, 0.8]}, 10.0, **ENDLESS)
    assert time.monotonic() - begin < 20.0


def test_progress(system: ac.System, capsys: pytest.CaptureFixture[str]) -> None:
    system.simulate(1.0, progress=True)
    assert not capsys.readouterr().err, "nothing in the first second"
    threading.Timer(2.5, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        system.simulate(10.0, progress=True, **ENDLESS)
    assert "% simulated, t = " in capsys.readouterr().err
