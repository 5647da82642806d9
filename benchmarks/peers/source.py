"""Modelica source of the RC ladder: resistor, capacitor, ground and source classes, connected cell by cell.

The line has R = 1 ohm and C = 1 F in all, so each of its N cells has R/N and C/N; a source of 1 V is switched on at
t = 0 with every capacitor empty. Its time constants run from 0.4 s down to 1/(4 N^2) s: stiff as soon as N is large.
"""

CLASSES = """\
connector Pin
  Real v;
  flow Real i;
end Pin;

partial model OnePort
  Pin p;
  Pin n;
  Real v;
  Real i;
equation
  v = p.v - n.v;
  0 = p.i + n.i;
  i = p.i;
end OnePort;

model Resistor
  extends OnePort;
  parameter Real R = 1;
equation
  v = R * i;
end Resistor;

model Capacitor
  extends OnePort(v(start = 0, fixed = true));
  parameter Real C = 1;
equation
  C * der(v) = i;
end Capacitor;

model ConstantVoltage
  extends OnePort;
  parameter Real V = 1;
equation
  v = V;
end ConstantVoltage;

model Ground
  Pin p;
equation
  p.v = 0;
end Ground;
"""


def ladder_with_arrays(cells: int) -> str:
    """The ladder with component arrays and a `for` loop over the connections."""
    return f"""{CLASSES}
model Ladder
  parameter Integer N = {cells};
  ConstantVoltage source(V = 1);
  Ground ground;
  Resistor r[N](each R = 1.0 / {cells});
  Capacitor c[N](each C = 1.0 / {cells});
equation
  connect(source.n, ground.p);
  connect(source.p, r[1].p);
  for k in 1:N loop
    connect(r[k].n, c[k].p);
    connect(c[k].n, ground.p);
  end for;
  for k in 1:N - 1 loop
    connect(r[k].n, r[k + 1].p);
  end for;
end Ladder;
"""


def ladder_unrolled(cells: int) -> str:
    """The same with one declaration for each component, for compilers without component arrays."""
    declarations = [
        f"  Resistor r{k}(R = {1.0 / cells!r});\n  Capacitor c{k}(C = {1.0 / cells!r});" for k in _cells(cells)
    ]
    connections = [f"  connect(r{k}.n, c{k}.p);\n  connect(c{k}.n, ground.p);" for k in _cells(cells)]
    connections += [f"  connect(r{k}.n, r{k + 1}.p);" for k in range(1, cells)]
    return "\n".join(
        [
            CLASSES,
            "model Ladder",
            "  ConstantVoltage source(V = 1);",
            "  Ground ground;",
            *declarations,
            "equation",
            "  connect(source.n, ground.p);",
            "  connect(source.p, r1.p);",
            *connections,
            "end Ladder;",
            "",
        ]
    )


def _cells(cells: int) -> range:
    return range(1, cells + 1)
