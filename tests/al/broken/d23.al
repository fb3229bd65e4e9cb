        REQUIRE water_pump.toml
        STAGE   "fetch a pin"
        OPEN    1
        MOVE    P1
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        STAGE   "and bring it back"
        MOVE    P1UP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 1.2
        OPEN    1
        PARK
