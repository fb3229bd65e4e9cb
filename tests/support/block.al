        STAGE   "pick the block up"
        OPEN    2.5
        MOVE    BLOCK
        CENTER  .8              ;where along the finger line it is
        CLOSE   .8              ;grasp it
        STAGE   "put it down"
        MOVE    OVER
        STOP    [0 0 -16]
        CHANGE  [0 0 -1] 1.5    ;until it stands on the table
        OPEN    2.5
        MOVE    PARK
