"""Other Modelica compilers for Python, timed on the same models. Development only: the package never imports them."""
