; drive one screw
        MOVE    D
        CENTER  .5
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        LOAD    15
        MOVE    H0
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5
        CHANGE  [0 0 1] 1
        PARK
