"""Two simulated gantries over one board: scene, rotors, wrists, beams, and the studies made with them."""
