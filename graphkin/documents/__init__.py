"""What is handed out: sheets, calculations and step pages, proved before they are drawn."""
