"""The plate of the pump: arm 1 lays the plate on its base and puts in two pins, and arm 2 drives six screws."""
