// Nothing runs this.
