"""Class lists and tables of answers as they come: CSV or XLSX, whatever their separator."""
