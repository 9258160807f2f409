#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""lossy_link.py NAME HERE THERE LOSS DELAY_S BYTES_S: a slow network link that loses packets.

For TCP on this machine: makes the network device NAME with the address HERE; who connects to THERE
reaches what listens on HERE, over a link that loses the share LOSS of all packets and takes DELAY_S
each way, and carries BYTES_S. Prints "ready" and runs until killed. Needs root.
(Linux's netem does the same, where the kernel has it.) A packet that the kernel sends to THERE comes
back with its addresses swapped, as if THERE had sent it; their sum stays, so the checksums do.
"""
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import sys
import time

TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
TCP = 6
QUEUE_S = 0.3  # of what the link carries; more is dropped, as a modem does


def open_device(name, here):
    device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", name.encode(), IFF_TUN | IFF_NO_PI))
    for command in (["addr", "add", f"{here}/30", "dev", name], ["link", "set", name, "up"]):
        subprocess.run(["ip", *command], check=True)
    return device


class Link:
    def __init__(self, device, loss, delay_s, bytes_s):
        self.device, self.loss, self.delay_s, self.bytes_s = device, loss, delay_s, bytes_s
        self.under_way = []  # (when it arrives, packet)
        self.free_s = 0.0  # when all that was sent has left

    def receive(self):
        while True:
            try:
                packet = os.read(self.device, 65536)
            except BlockingIOError:
                return
            if len(packet) >= 20 and packet[0] >> 4 == 4 and packet[9] == TCP:
                self.send(packet)

    def send(self, packet):
        now_s = time.monotonic()
        self.free_s = max(self.free_s, now_s)
        if self.free_s - now_s > QUEUE_S:
            return
        self.free_s += len(packet) / self.bytes_s
        if random.random() < self.loss:
            return
        swapped = packet[:12] + packet[16:20] + packet[12:16] + packet[20:]
        heapq.heappush(self.under_way, (self.free_s + self.delay_s, swapped))

    def deliver(self):
        while self.under_way and self.under_way[0][0] <= time.monotonic():
            os.write(self.device, heapq.heappop(self.under_way)[1])

    def wait_s(self):
        return max(0.0, self.under_way[0][0] - time.monotonic()) if self.under_way else None


def main():
    name, here, _, loss, delay_s, bytes_s = sys.argv[1:]
    random.seed(1)
    link = Link(open_device(name, here), float(loss), float(delay_s), float(bytes_s))
    print("ready", flush=True)
    while True:
        readable = select.select([link.device], [], [], link.wait_s())[0]
        if readable:
            link.receive()
        link.deliver()


if __name__ == "__main__":
    main()
