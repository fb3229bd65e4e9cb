"""The assembly line: a feeder brings pieces, two SUPERSIGMAs work on the pieces, and a belt takes the pieces away."""
