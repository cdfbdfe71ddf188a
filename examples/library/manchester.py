"""The Manchester benchmark with a wheel S1002 on a rail 60E1: forces and contact points of the right wheel for lateral
positions of a wheelset. usage: manchester.py [FOLDER_OF_PROFILES]"""
import pathlib
import sys

import contact

SPEED, RADIUS = 2000.0, 460.0  # [mm/s], [mm]
folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "profiles")

with contact.WheelRail("right", motion="steady") as pair:
    pair.set_material(g=82000.0, nu=0.28)
    pair.set_friction(0.3)
    pair.set_solver(eps=1e-5)
    pair.set_grid(dx=0.2, ds=0.2)
    pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025)
    pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=RADIUS)
    pair.set_rail(folder / "60E1.prr")
    pair.set_wheel(folder / "S1002.prw")
    pair.set_vertical_force(10000.0)

    print("# y wheelset [mm], patches, Fx, Fy on the rail [N], y and angle of the first contact [mm], [rad]")
    for y in range(7):
        pair.set_position(y=y, yaw=0.0024 * y)
        pair.set_velocity(SPEED, pitch=-SPEED / RADIUS)
        result = pair.solve()
        fx, fy, _ = result.forces.track.force
        first = result.patches[0]
        print(f"{y:5.1f} {len(result.patches):3d} {fx:9.1f} {fy:9.1f} {first.position[1]:10.3f} {first.angle:8.4f}")
