// Belongs to a program.
