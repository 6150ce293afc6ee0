#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From an unpacked map of format 3 to what fuzz_sections takes: sections without checksums."""
import struct
import sys

data = sys.stdin.buffer.read()
at = 16  # behind MRPT's frame
while at < len(data) - 1:
    tag, flags, size = struct.unpack_from("<4sIQ", data, at)
    payload = data[at + 24:at + 24 + size]
    if size < 1 << 16:
        sys.stdout.buffer.write(tag + struct.pack("<BH", flags >> 31, size) + payload)
    at += 24 + size + 8
