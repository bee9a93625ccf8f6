#!/usr/bin/env python3
"""Leads a hand round in the scene `spring` of a server and prints what it feels: drive_spring.py HOST:PORT [SECONDS]

The server's token, where it asks for one, is in MYOTACT_TOKEN.
"""
import json
import math
import os
import sys
import time

from myotact_client import Client, FORCE, ToolState, WireError, decode_force, token_of

RADIUS_M, TURNS_S, PERIOD_S = 0.03, 1.0, 0.01


def arguments():
    """Host, port and seconds. Raises ValueError."""
    if len(sys.argv) not in (2, 3):
        raise ValueError("usage: drive_spring.py HOST:PORT [SECONDS]")
    host, _, port = sys.argv[1].rpartition(":")
    if not host or not port.isdecimal() or not 1 <= int(port) <= 65535:
        raise ValueError(f"{sys.argv[1]}: is no HOST:PORT with a port of 1 to 65535")
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 5.0
    if not 0 < seconds <= 86400:
        raise ValueError(f"{sys.argv[2]}: is no time of 0 to 86400 seconds")
    return host, int(port), seconds


def stiffness_N_m(scene_json):
    """Raises WireError when the server shows another scene."""
    scene = json.loads(json.loads(scene_json)["scene"]["text"])
    if "spring" not in scene.get("original", {}):
        raise WireError(f"the server shows the scene {scene['name']}; start it with `myotact serve spring`")
    return scene["original"]["spring"]["stiffness_N_m"]


def lead_round(client, seconds):
    k = stiffness_N_m(client.scene_json)
    if client.welcome.hand < 0:
        raise WireError("all hands of the scene are taken; `myotact serve --hands` has more of them")
    print("t_s,x_m,y_m,force_x_N,force_y_N,difference_N")
    for i in range(round(seconds / PERIOD_S)):
        angle = 2 * math.pi * i * PERIOD_S / TURNS_S
        hand = (RADIUS_M * math.cos(angle), RADIUS_M * math.sin(angle), 0.0)
        client.send_state(ToolState(hand, sequence=i + 1))
        force = decode_force(client.read_until(FORCE).payload).force_world_N
        difference = math.dist(force, [-k * x for x in hand])
        print(f"{i * PERIOD_S:.2f},{hand[0]:.5f},{hand[1]:.5f},{force[0]:.4f},{force[1]:.4f},{difference:.4f}")
        if not client.welcome.lockstep:
            time.sleep(PERIOD_S)


def main():
    try:
        host, port, seconds = arguments()
        token = token_of(os.environ.get("MYOTACT_TOKEN", ""))
    except ValueError as why:
        print(why, file=sys.stderr)
        sys.exit(2)
    try:
        with Client(host, port, token=token) as client:
            lead_round(client, seconds)
    except WireError as why:
        sys.exit(str(why))
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
