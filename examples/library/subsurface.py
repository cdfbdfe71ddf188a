"""Stresses below a ball that slides over a plane: their largest value moves towards the surface with friction."""
import contact
import numpy as np

with contact.Problem(motion="steady") as ball:
    ball.set_material(g=80000.0, nu=0.3)
    ball.set_hertz(40, 40, aa=1.0, bb=1.0, scale=1.1)
    ball.set_normal_force(2000.0)
    # A creepage with full sliding; the force on the ball is in the direction of -x
    ball.set_creepages(1.0)
    # Plane below the middle of the contact, in steps of 0.1 and 0.05 mm
    ball.add_block(x=0.1 * np.arange(-12, 13), y=0.0, z=0.05 * np.arange(31))

    print("# friction, largest von Mises stress [N/mm2], its position x, z [mm]")
    for friction in (0.0001, 0.15, 0.3, 0.5):
        ball.set_friction(friction)
        ball.solve()
        stresses = ball.stresses()
        iz, _, ix = np.unravel_index(np.argmax(stresses.von_mises), stresses.von_mises.shape)
        print(f"{friction:7.4f} {stresses.von_mises.max():8.1f} {stresses.x[ix]:6.2f} {stresses.z[iz]:5.2f}")
