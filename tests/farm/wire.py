#!/usr/bin/env python3
"""A wire between two network namespaces that delays packets and loses some of them.

wire.py NAMESPACE ADDRESS NAMESPACE ADDRESS MILLISECONDS LOSS

Addresses are like 10.77.0.1/24; LOSS is a share of the packets. For kernels without netem, which would
be simpler. Runs as root until it is killed."""

import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import sys
import time

IFF_TUN, IFF_NO_PI, TUNSETIFF = 0x1, 0x1000, 0x400454CA


def end_in(namespace, address, name):
    """Returns a descriptor of packets that leave a namespace, and that enter it."""
    end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH", name.encode(), IFF_TUN | IFF_NO_PI))
    subprocess.run(["ip", "link", "set", name, "netns", namespace], check=True)
    for words in (["addr", "add", address, "dev", name], ["link", "set", name, "up"],
                  ["link", "set", "lo", "up"]):
        subprocess.run(["ip", "-n", namespace, *words], check=True)
    return end


def main(namespace, address, other, other_address, milliseconds, loss):
    ends = [end_in(namespace, address, "wire0"), end_in(other, other_address, "wire1")]
    print("ready", flush=True)
    underway, number = [], 0
    while True:
        wait = max(0.0, underway[0][0] - time.monotonic()) if underway else None
        for ready in select.select(ends, [], [], wait)[0]:
            packet = os.read(ready, 65536)
            if random.random() < float(loss):
                continue
            number += 1
            due = time.monotonic() + float(milliseconds) / 1000
            heapq.heappush(underway, (due, number, ends[ready == ends[0]], packet))
        while underway and underway[0][0] <= time.monotonic():
            _, _, end, packet = heapq.heappop(underway)
            try:
                os.write(end, packet)
            except BlockingIOError:
                pass  # lost


main(*sys.argv[1:])
