"""Two simulated gantries over one board: their scene, rotors, wrists and beams, and studies made with them."""
