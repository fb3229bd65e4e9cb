        STAGE   "one screw"
        OPEN    1.6
        MOVE    D
        CENTER  .5
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        LOAD    15
        MOVE    S1
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5 .4
        CHANGE  [0 0 1] 1.5
        MOVE    H0
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .9 .4
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5
        TOOL    0
        TRAVEL  .15 .35
        CHANGE  [0 0 1] 1
        MOVE    DUP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] .8
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2
        PARK
