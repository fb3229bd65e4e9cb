"""The MICROBUS below the wall: wires, receivers with clocks of their own, segments, faults, and its timing diagram."""
