"""YAML, parameter, design and rig files; installed files; outputs that appear whole."""
