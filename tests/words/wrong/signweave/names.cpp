struct Place {
  struct Part {};
};
class Part;
