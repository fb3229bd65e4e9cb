; set the block down gently
        TRANS   BLOCK [20 33 4 90 90 0]
        TRANS   SHELF [27 34 4.5 90 90 0]
        OPEN    2
        MOVE    BLOCK
        CLOSE   .8 1.2
        LOAD    20
        CHANGE  [0 0 1] 1
        MOVE    SHELF
        STOP    [0 0 30]        ;the shelf pushes up
        CHANGE  [0 0 -1] 1.5
        LOAD    0
        OPEN    2
        PARK
