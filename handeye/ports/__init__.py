"""The honesty wall: the devices of a cell as the working phase knows them."""
