"""What is wrong with a program whose form is right."""
