"""Traction curves: tangential force over creepage, for clean rollers and with a soft layer between them."""
import contact

CREEPAGES = (0.0, 0.0005, 0.001, 0.002, 0.003, 0.005, 0.008, 0.012, 0.02, 0.04, 0.1)


def rollers(**material):
    """Steady rolling in mm and N"""
    problem = contact.Problem(motion="steady")
    problem.set_material(g=82000.0, nu=0.28, **material)
    problem.set_friction(0.35)
    problem.set_rolling(velocity=25000.0)
    problem.set_hertz(25, 25, aa=6.5, bb=5.0, scale=1.2)
    problem.set_normal_force(70000.0)
    problem.set_solver(eps=1e-6)
    return problem


# Layer: shear modulus [N/mm2] and thickness [mm]; it does not yield
with rollers() as clean, rollers(model=4, parameters=[100.0, 0.02, 0.0, 0.0]) as layer:
    print("# creepage, Fx / Fn clean, Fx / Fn with layer")
    for creepage in CREEPAGES:
        ratios = []
        for problem in (clean, layer):
            problem.set_creepages(creepage)
            result = problem.solve()
            ratios.append(result.fx / result.fn)
        print(f"{creepage:8.4f} {ratios[0]:9.5f} {ratios[1]:9.5f}")
