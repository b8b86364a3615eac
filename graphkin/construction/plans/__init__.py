"""What is drawn alike in the plans of velocities and of accelerations."""
