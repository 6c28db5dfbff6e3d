"""What the launch files need: rigs, names, descriptions of units, actions."""
