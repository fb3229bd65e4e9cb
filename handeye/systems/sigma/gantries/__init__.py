"""Two gantries over one board, with physics: scene, rotors, wrists, beams, and what is studied on them."""
