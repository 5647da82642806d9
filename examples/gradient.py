"""The gradient of a whole simulation: with which damper does the body of the quarter car move least?"""
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false, reportMissingTypeStubs=false
# (the stubs of the plotting and numerical libraries are incomplete)

import jax
import jax.numpy as jnp
from quarter_car import QuarterCar
from scipy.optimize import minimize

import acausal as ac
from acausal.components import translational as tr


def main() -> float:
    """Minimise over the damping; returns the best [N s/m]."""
    system = ac.compile(QuarterCar(suspension=tr.SpringDamper(c=2e4, d=1500.0)))
    times = jnp.linspace(0.0, 3.0, 301)

    def motion(damping: jax.Array) -> jax.Array:
        """Mean square of the body's position [mm2] for a damping in kN s/m."""
        solution = system.simulate(t1=3.0, parameters={"suspension.d": 1e3 * damping[0]}, saveat=times)
        return jnp.mean((1e3 * solution["body.s"]) ** 2)

    value_and_gradient = ac.jit(jax.value_and_grad(motion))
    found = minimize(value_and_gradient, jnp.asarray([1.5]), jac=True, bounds=[(0.1, 5.0)])
    best = 1e3 * float(found.x[0])
    print(f"damping {best:.1f} N s/m: mean square {float(found.fun):.3f} mm2, after {found.nfev} simulations")
    return best


if __name__ == "__main__":
    main()
