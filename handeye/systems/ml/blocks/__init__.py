"""The job `blocks`: the arm takes three toy blocks from the table and stacks them. It finds them by touch."""
