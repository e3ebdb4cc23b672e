FORMULA real exp_(real x) { return x; }
FORMULA real log_(real x) { return x; }
