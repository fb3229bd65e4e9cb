"""The assembly line: a feeder brings pieces, two SUPERSIGMAs work on them, and a belt withdraws them."""
