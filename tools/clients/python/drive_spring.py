#!/usr/bin/env python3
"""Leads a hand round in the scene `spring` of a server and prints what it feels: drive_spring.py HOST:PORT [SECONDS]

The server's token, where it asks for one, is in MYOTACT_TOKEN.
"""
import json
import math
import os
import sys
import time

from myotact_client import Client, FORCE, ToolState, decode_force

RADIUS_M, TURNS_S, PERIOD_S = 0.03, 1.0, 0.01


def stiffness_N_m(scene_json):
    scene = json.loads(json.loads(scene_json)["scene"]["text"])
    return scene["original"]["spring"]["stiffness_N_m"]


def main():
    host, port = sys.argv[1].rsplit(":", 1)
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 5.0
    token = bytes.fromhex(os.environ.get("MYOTACT_TOKEN", "") or "00" * 16)
    with Client(host, int(port), token=token) as client:
        k = stiffness_N_m(client.scene_json)
        print("t_s,x_m,y_m,force_x_N,force_y_N,difference_N")
        for i in range(round(seconds / PERIOD_S)):
            angle = 2 * math.pi * i * PERIOD_S / TURNS_S
            hand = (RADIUS_M * math.cos(angle), RADIUS_M * math.sin(angle), 0.0)
            client.tell(ToolState(hand, sequence=i + 1))
            force = decode_force(client.read_until(FORCE).payload).force_world_N
            difference = math.dist(force, [-k * x for x in hand])
            print(f"{i * PERIOD_S:.2f},{hand[0]:.5f},{hand[1]:.5f},{force[0]:.4f},{force[1]:.4f},{difference:.4f}")
            if not client.welcome.lockstep:
                time.sleep(PERIOD_S)


if __name__ == "__main__":
    main()
