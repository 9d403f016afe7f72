"""./run bench: run time against error of every technique, measured, plotted and written up."""
