"""Test models of ModelicaTest.Tables 4.0: all tables over the same signals, named as the models they are in."""

from __future__ import annotations

from acausal import Component
from acausal.components import blocks
from acausal.components.examples import assemble

POINTS_1 = (
    (0.1, 0.0),
    (0.3, 0.0),
    (0.5, -1.0),
    (0.51, -2.0),
    (0.51, -3.0),
    (0.6, -2.0),
    (0.7, -2.0),
    (0.7, -2.0),
    (1.0, -4.0),
)
POINTS_6 = (
    (0.1, 0.0),
    (0.2, 0.0),
    (0.3, 0.0),
    (0.5, -1.0),
    (0.51, -2.0),
    (0.51, -3.0),
    (0.6, -2.0),
    (0.7, -2.0),
    (0.7, -2.0),
    (1.0, -4.0),
)
POINTS_46 = (
    (0.6, -2.0),
    (0.6, -20.0),
    (0.6, -3.0),
    (0.7, -2.0),
    (0.7, 0.0),
    (0.7, -2.0),
    (1.0, -5.0),
    (1.0, -6.0),
    (1.0, -4.0),
)
POINTS_51 = ((0.6, -2.0), (0.6, -3.0), (0.7, -2.0), (1.0, -5.0), (1.0, -6.0), (1.0, -4.0))
POINTS_5 = ((0.3, 0.0, 0.0), (0.4, 1.0, -1.0), (0.5, 0.0, 0.0), (0.6, -1.0, 1.0), (0.7, 0.0, 0.0))
POINTS_74 = (
    (0.0, 10.0),
    (2.0, 10.0),
    (3.0, 10.0),
    (5.0, 10.0),
    (6.0, 10.0),
    (8.0, 10.0),
    (9.0, 10.5),
    (11.0, 15.0),
    (12.0, 50.0),
    (14.0, 60.0),
    (15.0, 85.0),
)
MAP_1 = (
    (0.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0),
    (0.0, 58.2, 61.5, 47.9, 62.3, 34.6, 45.5, 38.2, 41.2, 41.7),
    (5.0, 37.2, 40.0, 27.0, 41.3, 14.1, 24.5, 17.3, 20.2, 20.8),
    (10.0, 22.4, 22.5, 14.6, 22.5, 4.7, 7.2, 1.8, 2.1, 2.1),
    (15.0, 21.8, 20.5, 12.8, 17.6, 5.8, 7.6, 0.8, 0.6, 0.6),
    (20.0, 16.8, 14.4, 8.1, 6.9, 6.2, 0.6, 0.1, 0.0, 0.0),
    (25.0, 12.0, 8.0, 5.3, 2.9, 0.6, 0.0, 0.0, 0.0, 0.0),
    (30.0, 7.4, 4.8, 1.4, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0),
    (35.0, 3.2, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (40.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (45.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
)
"""Points of several tables, named after the first."""


def time_tables_to_2_5() -> Component:
    """Those of CombiTimeTable that stop at 2.5 s."""
    return assemble(
        test1=blocks.CombiTimeTable(table=POINTS_1, extrapolation="Periodic"),
        test6=blocks.CombiTimeTable(table=POINTS_6, extrapolation="Periodic", startTime=0.1),
        test15=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0)), startTime=0.5),
        test16=blocks.CombiTimeTable(table=((0.25, 1.0), (1.25, 0.0)), startTime=0.25),
        test17=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0)), extrapolation="HoldLastPoint", startTime=0.5),
        test18=blocks.CombiTimeTable(table=((0.25, 1.0), (1.25, 0.0)), extrapolation="HoldLastPoint", startTime=0.25),
        test19=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (1.0, 0.0)), startTime=0.5),
        test20=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (1.0, 0.0)), startTime=0.25),
        test21=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.5),
        test22=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.25),
        test23=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 0.0)), startTime=0.5),
        test24=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 0.0)), startTime=0.25),
        test25=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 0.0)),
            extrapolation="HoldLastPoint", startTime=0.5),
        test26=blocks.CombiTimeTable(table=((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 0.0)),
            extrapolation="HoldLastPoint", startTime=0.25),
        test27=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0), (1.0, 0.0)), startTime=0.5),
        test28=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0), (1.0, 0.0)), startTime=0.25),
        test29=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.5),
        test30=blocks.CombiTimeTable(table=((0.0, 1.0), (1.0, 0.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.25), test31=blocks.CombiTimeTable(table=((0.0, 1.0), (0.0, 1.0), (1.0, 0.0)), startTime=0.5),
        test32=blocks.CombiTimeTable(table=((0.0, 1.0), (0.0, 1.0), (1.0, 0.0)), startTime=0.25),
        test33=blocks.CombiTimeTable(table=((0.0, 1.0), (0.0, 1.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.5),
        test34=blocks.CombiTimeTable(table=((0.0, 1.0), (0.0, 1.0), (1.0, 0.0)), extrapolation="HoldLastPoint",
            startTime=0.25),
        test42=blocks.CombiTimeTable(table=((0.6, -2.0), (0.7, -2.0), (0.7, -2.0), (1.0, -4.0)),
            extrapolation="Periodic"),
        test43=blocks.CombiTimeTable(table=((0.6, -2.0), (0.7, -2.0), (0.7, -2.0), (1.0, -4.0)),
            extrapolation="Periodic", startTime=0.5),
        test44=blocks.CombiTimeTable(table=((0.6, -2.0), (0.7, -2.0), (0.7, -2.0), (1.0, -4.0)),
            extrapolation="Periodic", startTime=0.7),
        test45=blocks.CombiTimeTable(table=((0.6, -2.0), (0.7, -2.0), (0.7, -2.0), (1.0, -4.0)),
            extrapolation="Periodic", startTime=1.5),
        test46=blocks.CombiTimeTable(table=POINTS_46, extrapolation="Periodic"),
        test47=blocks.CombiTimeTable(table=POINTS_46, extrapolation="Periodic", startTime=0.5),
        test48=blocks.CombiTimeTable(table=POINTS_46, extrapolation="Periodic", startTime=0.7),
        test49=blocks.CombiTimeTable(table=POINTS_46, extrapolation="Periodic", startTime=1.5),
        test51=blocks.CombiTimeTable(table=POINTS_51, extrapolation="Periodic"),
        test52=blocks.CombiTimeTable(table=POINTS_51, extrapolation="Periodic", startTime=0.5),
        test53=blocks.CombiTimeTable(table=POINTS_51, extrapolation="Periodic", startTime=0.7),
        test54=blocks.CombiTimeTable(table=POINTS_51, extrapolation="Periodic", startTime=1.5),
        test61=blocks.CombiTimeTable(table=POINTS_46, smoothness="ConstantSegments", extrapolation="Periodic"),
        test62=blocks.CombiTimeTable(table=POINTS_46, smoothness="ConstantSegments", extrapolation="Periodic",
            startTime=0.5),
        test63=blocks.CombiTimeTable(table=POINTS_46, smoothness="ConstantSegments", extrapolation="Periodic",
            startTime=0.7),
        test64=blocks.CombiTimeTable(table=POINTS_46, smoothness="ConstantSegments", extrapolation="Periodic",
            startTime=1.5),
    )  # fmt: skip


def time_tables_to_1() -> Component:
    """Those of CombiTimeTable that stop at 1.0 s."""
    return assemble(
        test4=blocks.CombiTimeTable(table=((0.3, 0.0), (0.4, 1.0), (0.5, 0.0), (0.6, -1.0), (0.7, 0.0)),
            smoothness="ContinuousDerivative"),
        test5=blocks.CombiTimeTable(table=POINTS_5, smoothness="ContinuousDerivative"),
        test7=blocks.CombiTimeTable(table=POINTS_5, columns=(3.0,), smoothness="ContinuousDerivative"),
        test8=blocks.CombiTimeTable(table=POINTS_5, columns=(2.0, 3.0), smoothness="ContinuousDerivative"),
        test65=blocks.CombiTimeTable(table=((0.3, 0.0), (0.4, 1.0), (0.5, 0.0), (0.6, -1.0), (0.7, 0.0)),
            smoothness="ConstantSegments"),
    )  # fmt: skip


def time_tables_to_3_5() -> Component:
    """Those of CombiTimeTable that stop at 3.5 s."""
    return assemble(
        test9=blocks.CombiTimeTable(table=((0.0, 0.0), (2.5, 0.0), (2.5, 1.0), (3.0, 1.0), (3.0, 0.0))),
        test37=blocks.CombiTimeTable(table=((0.0, 0.0), (2.5, 1.0), (3.0, 0.0)), smoothness="ConstantSegments",
            extrapolation="HoldLastPoint"),
    )  # fmt: skip


def time_tables_to_15() -> Component:
    """Those of CombiTimeTable that stop at 15.0 s."""
    return assemble(
        test74=blocks.CombiTimeTable(table=POINTS_74, smoothness="MonotoneContinuousDerivative1"),
        test78=blocks.CombiTimeTable(table=POINTS_74, smoothness="MonotoneContinuousDerivative2"),
    )  # fmt: skip


def tables_to_1() -> Component:
    """Those of CombiTable1Ds that stop at 1.0 s."""
    return assemble(
        "clock.y - test3.u - test4.u - test5.u - test6.u",
        test3=blocks.CombiTable1Ds(table=((0.3, 0.0), (0.4, 1.0), (0.5, 0.0), (0.6, -1.0), (0.7, 0.0)),
            smoothness="ContinuousDerivative"), clock=blocks.ContinuousClock(),
        test4=blocks.CombiTable1Ds(table=POINTS_5, smoothness="ContinuousDerivative"),
        test5=blocks.CombiTable1Ds(table=POINTS_5, columns=(3.0,), smoothness="ContinuousDerivative"),
        test6=blocks.CombiTable1Ds(table=POINTS_5, columns=(2.0, 3.0), smoothness="ContinuousDerivative"),
    )  # fmt: skip


def tables_to_15() -> Component:
    """Those of CombiTable1Ds that stop at 15.0 s."""
    return assemble(
        "clock.y - test27.u - test31.u",
        test27=blocks.CombiTable1Ds(table=POINTS_74, smoothness="MonotoneContinuousDerivative1"),
        clock=blocks.ContinuousClock(),
        test31=blocks.CombiTable1Ds(table=POINTS_74, smoothness="MonotoneContinuousDerivative2"),
    )  # fmt: skip


def maps_to_60() -> Component:
    """Those of CombiTable2Ds that stop at 60.0 s."""
    return assemble(
        "clock.y - test1.u1 - test2.u2 - test3.u1 - test3.u2 - test4.u1 - test5.u2 - test6.u2 - test6.u1 - test7.u1",
        "clock.y - test8.u2 - test9.u1 - test9.u2",
        "const.y - test1.u2 - test2.u1 - test4.u2 - test5.u1 - test7.u2 - test8.u1",
        test1=blocks.CombiTable2Ds(table=MAP_1, smoothness="ContinuousDerivative"), clock=blocks.ContinuousClock(),
        const=blocks.Constant(k=2.0), test2=blocks.CombiTable2Ds(table=MAP_1, smoothness="ContinuousDerivative"),
        test3=blocks.CombiTable2Ds(table=MAP_1, smoothness="ContinuousDerivative"),
        test4=blocks.CombiTable2Ds(table=MAP_1), test5=blocks.CombiTable2Ds(table=MAP_1),
        test6=blocks.CombiTable2Ds(table=MAP_1), test7=blocks.CombiTable2Ds(table=MAP_1, smoothness="ConstantSegments"),
        test8=blocks.CombiTable2Ds(table=MAP_1, smoothness="ConstantSegments"),
        test9=blocks.CombiTable2Ds(table=MAP_1, smoothness="ConstantSegments"),
    )  # fmt: skip


def maps_to_1() -> Component:
    """Those of CombiTable2Ds that stop at 1.0 s."""
    return assemble(
        "clock1.y - test24.u1 - test24.u2 - test25.u1 - test25.u2 - test26.u1 - test26.u2 - test27.u1 - test27.u2",
        "clock1.y - test28.u1 - test28.u2 - test29.u1 - test29.u2 - test30.u1 - test30.u2",
        test24=blocks.CombiTable2Ds(table=((0.0, 0.0, 1.0), (0.5, 1.0, 2.0)), smoothness="ContinuousDerivative"),
        clock1=blocks.ContinuousClock(),
        test25=blocks.CombiTable2Ds(table=((0.0, 0.5), (0.0, 1.0), (1.0, 2.0)), smoothness="ContinuousDerivative"),
        test26=blocks.CombiTable2Ds(table=((0.0, 0.0, 0.5, 1.0), (0.5, 1.0, 2.0, 1.0)),
            smoothness="ContinuousDerivative"),
        test27=blocks.CombiTable2Ds(table=((0.0, 0.5), (0.0, 1.0), (0.5, 2.0), (1.0, 1.0)),
            smoothness="ContinuousDerivative"),
        test28=blocks.CombiTable2Ds(table=((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0)),
            smoothness="ContinuousDerivative"),
        test29=blocks.CombiTable2Ds(table=((0.0, 0.0, 0.5, 1.0), (0.0, 1.0, 2.0, 1.0), (1.0, 1.0, 1.0, 1.0)),
            smoothness="ContinuousDerivative"),
        test30=blocks.CombiTable2Ds(table=((0.0, 0.0, 1.0), (0.0, 1.0, 1.0), (0.5, 2.0, 1.0), (1.0, 1.0, 1.0)),
            smoothness="ContinuousDerivative"),
    )  # fmt: skip
