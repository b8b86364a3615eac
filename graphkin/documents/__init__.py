"""The documents handed out: sheets, calculations and step pages, all verified before drawing."""
