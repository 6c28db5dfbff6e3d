"""From files to a `Recording`: tables and bags, units and clocks."""
