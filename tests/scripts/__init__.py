"""The scripts of the pages: checks with Node's tools, and the bundles that the package holds."""
